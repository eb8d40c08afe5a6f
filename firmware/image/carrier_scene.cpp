// The controller of one scene on a board whose carrier interrupts, with the targets of the scene and without
// a host: it drives from power-on. Its commands are compared with those of the workstation.
#include SONOGLIDE_BOARD_HEADER

#include <cstdint>

#include "controller_configuration.hpp"
#include "firmware/app/control_loop.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/app/texture.hpp"
#include "firmware/control/controller.hpp"
#include "firmware/image/carrier/carrier_board.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
namespace app = sonoglide::app;
namespace configuration = app::configuration;
using CarrierBoard =
    sonoglide::image::BoardOf<Hardware, decltype(configuration::target_steps)>::Type;

constexpr std::uint32_t ticks =
    sonoglide::image::CarrierTicks<configuration::Parts, CarrierBoard, configuration::every_periods,
                                   configuration::delay_periods, configuration::interpolates,
                                   app::tuned>::of(configuration::carrier_period_s);
static_assert(ticks != 0,
              "this board cannot make drive.frequency_Hz; its README lists those it can");

using Controller = sonoglide::control::Controller<configuration::Parts>;
using Answer = app::DriveOf<Controller>;

/// The board, whose answers are there for who watches the memory.
class ShownBoard : public CarrierBoard {
 public:
  using CarrierBoard::CarrierBoard;
  void drive(const Answer& answer);
};

using Targets = decltype(app::schedule_of<ShownBoard>(configuration::target_steps));

struct Run {
  Controller controller{configuration::parameters};
  ShownBoard board{ticks};
  app::ControlLoop<Controller, ShownBoard> loop{controller, board};
  Targets targets = app::schedule_of<ShownBoard>(configuration::target_steps);
};

Run* run;  // set before the carrier interrupts

}  // namespace

extern "C" {
Answer last_answer;

void take_carrier() {
  run->targets.advance(run->controller);
  run->loop.serve(run->targets);
}
}

namespace {
void ShownBoard::drive(const Answer& answer) {
  CarrierBoard::drive(answer);
  last_answer = answer;
}
}  // namespace

int main() {
  Run own;
  own.controller.start();
  app::tune(own.board, configuration::carrier_period_s);
  run = &own;
  CarrierBoard::interrupt();
  for (;;) {
  }
}
