/// The controller of the product on a board, the same on the device and on the workstation.
#pragma once

#include "controller_configuration.hpp"
#include "firmware/app/control_loop.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/control/controller.hpp"

/// Serves one carrier period after the other until the board shuts down.
template <class Board>
void run_product(Board& board) {
  namespace app = sonoglide::app;
  sonoglide::control::Controller<app::configuration::Parts> controller(
      app::configuration::parameters);
  controller.start();
  app::ControlLoop loop(controller, board);
  app::TargetSchedule targets(app::configuration::target_steps);
  do {
    targets.advance(controller);
  } while (loop.serve());
}
