/// A micro:bit in lockstep over its USB serial line.
#pragma once

#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/microbit/uart.hpp"

namespace sonoglide::hal::microbit {

using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart>>;

}  // namespace sonoglide::hal::microbit
