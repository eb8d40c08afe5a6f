#include "hal/start/image_end.hpp"

#include "hal/semihosting/semihosting.hpp"

namespace semihosting = sonoglide::hal::semihosting;

extern "C" {

void leave_image(int code) {
  semihosting::leave(static_cast<semihosting::ExitCode>(code));
}

void take_exception() {
  semihosting::leave(semihosting::ExitCode::processor_fault);
}

}  // extern "C"
