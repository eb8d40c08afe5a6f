// The image of one scene's controller on an MPS2 board in lockstep with its host.
#include "controller_configuration.hpp"
#include "firmware/app/control_loop.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/control/controller.hpp"
#include "hal/mps2/lockstep_board.hpp"

int main() {
  namespace configuration = sonoglide::app::configuration;
  sonoglide::control::Controller<configuration::Parts> controller(configuration::parameters);
  controller.start();
  sonoglide::hal::mps2::LockstepBoard board;
  sonoglide::app::ControlLoop loop(controller, board);
  sonoglide::app::TargetSchedule targets(configuration::target_steps);
  do {
    targets.advance(controller);
  } while (loop.serve());
  return 0;
}
