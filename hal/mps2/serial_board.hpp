/// An MPS2 board in lockstep over UART0.
#pragma once

#include <cstdint>

#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/mps2/uart.hpp"

namespace sonoglide::hal::mps2 {

template <std::uint32_t ClockHz>
using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart<ClockHz>>>;

using An385SerialBoard = SerialBoard<25000000>;  ///< AN386 and AN500 as well
using An505SerialBoard = SerialBoard<20000000>;

}  // namespace sonoglide::hal::mps2
