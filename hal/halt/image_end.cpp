// An image that nobody watches halts where it ends, with its drive at zero. A watchdog, if there is
// one, then resets the board.
#include "hal/start/image_end.hpp"

#include "hal/timed/drive_register.hpp"

extern "C" {

volatile std::int32_t drive_amplitude = 0;

void shutdown() {
  drive_amplitude = 0;
}

void leave_image(int /*code*/) {
  for (;;) {
    shutdown();
  }
}

void take_exception() {
  leave_image(0);
}

}  // extern "C"
