// An image that nobody watches halts where it ends. A drive that is the processor's own doing ends
// with it, and the watchdog, where there is one, resets the board.
#include "hal/start/image_end.hpp"

extern "C" {

void leave_image(int /*code*/) {
  for (;;) {
  }
}

void take_exception() {
  leave_image(0);
}

}  // extern "C"
