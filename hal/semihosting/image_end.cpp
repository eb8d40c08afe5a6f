#include "hal/start/image_end.hpp"

#include "hal/lockstep/frame.hpp"
#include "hal/semihosting/semihosting.hpp"

using sonoglide::hal::lockstep::ExitCode;

extern "C" {

void leave_image(int code) {
  sonoglide::hal::semihosting::leave(code);
}

void take_exception() {
  leave_image(static_cast<int>(ExitCode::processor_fault));
}

}  // extern "C"
