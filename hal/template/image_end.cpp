// However the image ends, the drive is off.
#include "hal/start/image_end.hpp"

#include "hal/template/board.hpp"

using sonoglide::hal::template_board::carrier;

extern "C" {

void shutdown() {
  carrier.amplitude = 0;
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
