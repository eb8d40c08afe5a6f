/// QEMU's RISC-V virt in lockstep over its serial line.
#pragma once

#include "hal/lockstep/board/lockstep_board.hpp"
#include "hal/lockstep/board/serial_link.hpp"
#include "hal/riscv_virt/uart.hpp"

namespace sonoglide::hal::riscv_virt {

using SerialBoard = lockstep::LockstepBoard<lockstep::SerialLink<Uart>>;

}  // namespace sonoglide::hal::riscv_virt
