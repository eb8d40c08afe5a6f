// The image of one scene's controller on one board; both are chosen when the image is built.
#include SONOGLIDE_BOARD_HEADER

#include "controller_configuration.hpp"
#include "firmware/app/control_loop.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/control/controller.hpp"

int main() {
  namespace configuration = sonoglide::app::configuration;
  sonoglide::control::Controller<configuration::Parts> controller(configuration::parameters);
  controller.start();
  SONOGLIDE_BOARD_CLASS board;
  sonoglide::app::ControlLoop loop(controller, board);
  sonoglide::app::TargetSchedule targets(configuration::target_steps);
  do {
    targets.advance(controller);
  } while (loop.serve());
  return 0;
}
