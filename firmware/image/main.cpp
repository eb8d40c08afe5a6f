// The image of one scene's controller on one board; both are chosen when the image is built.
#include SONOGLIDE_BOARD_HEADER

#include "controller_configuration.hpp"
#include "firmware/app/control_loop.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/app/texture.hpp"
#include "firmware/app/timed_targets.hpp"
#include "firmware/control/controller.hpp"

int main() {
  namespace configuration = sonoglide::app::configuration;
  sonoglide::control::Controller<configuration::Parts> controller(configuration::parameters);
  controller.start();
  SONOGLIDE_BOARD_CLASS board;
  sonoglide::app::ControlLoop loop(controller, board);
  auto targets = sonoglide::app::schedule_of<SONOGLIDE_BOARD_CLASS>(configuration::target_steps);
  // For who measures the image: symbols of the size of what each part keeps, which is on the stack.
  // They stand where there is no memory.
  asm volatile inline(
      ".global controller_state, application_state, board_state \n"
      ".set controller_state, 0xffffffff \n"
      ".set application_state, 0xffffffff \n"
      ".set board_state, 0xffffffff \n"
      ".size controller_state, %c0 \n"
      ".size application_state, %c1 \n"
      ".size board_state, %c2 \n"
      :
      : "i"(sizeof controller), "i"(sizeof loop + sizeof targets), "i"(sizeof board));
  do {
    targets.advance(controller);
  } while (loop.serve(targets));
  return 0;
}
