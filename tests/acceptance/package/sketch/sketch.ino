#include <Sonoglide.h>

#include "controller_configuration.hpp"

namespace app = sonoglide::app;

/// Converters and drive of this product.
class Board {
 public:
  bool sample(sonoglide::hal::Sample& sample) {
    sample = {friction_code(), velocity_code(), false, true};
    return true;
  }
  void drive(const sonoglide::hal::Drive& drive) { set_amplitude(drive.amplitude); }

 private:
  static std::int32_t friction_code() { return analogRead(A0) * (INT32_C(1) << 20); }
  static std::int32_t velocity_code() { return analogRead(A1) * (INT32_C(1) << 20); }
  static void set_amplitude(std::int32_t amplitude) { analogWrite(9, amplitude >> 23); }
};

sonoglide::control::Controller<app::configuration::Parts> controller(app::configuration::parameters);
Board board;
app::ControlLoop control_loop(controller, board);
app::TargetSchedule targets(app::configuration::target_steps);

void setup() { controller.start(); }

void loop() {
  targets.advance(controller);
  control_loop.serve();
}
