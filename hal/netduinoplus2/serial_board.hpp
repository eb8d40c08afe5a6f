/// A Netduino Plus 2 in lockstep over USART1.
#pragma once

#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/netduinoplus2/uart.hpp"

namespace sonoglide::hal::netduinoplus2 {

using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart>>;

}  // namespace sonoglide::hal::netduinoplus2
