/// Serial line of QEMU's RISC-V virt: an NS16550A.
#pragma once

#include <cstdint>

namespace sonoglide::hal::riscv_virt {

/// A byte link, see hal/board.hpp: 115200 baud, 8 data bits, no parity, one stop bit.
class Uart {
 public:
  Uart();
  bool receive(std::uint8_t& byte);
  bool send(std::uint8_t byte);
};

}  // namespace sonoglide::hal::riscv_virt
