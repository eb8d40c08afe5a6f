/// How an image in lockstep ends; what the emulator's process returns.
#pragma once

namespace sonoglide::hal::lockstep {

enum class ExitCode : int {
  shut_down = 0,        ///< the host closed the link between two frames
  link_broken = 1,      ///< a frame was cut short, out of turn, or could not be sent
  processor_fault = 2,  ///< an exception was taken; none is expected
};

}  // namespace sonoglide::hal::lockstep
