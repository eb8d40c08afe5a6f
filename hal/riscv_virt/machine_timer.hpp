/// Machine timer of QEMU's RISC-V virt.
#pragma once

#include <cstdint>

namespace sonoglide::hal::riscv_virt {

/// Source: RISC-V Advanced Core Local Interruptor, MTIMER; address from memory.ld.
extern "C" volatile const std::uint32_t machine_time_low;

/// The low half of mtime, which runs since power-on.
class MachineTimer {
 public:
  static constexpr std::uint32_t hz = 10000000;
  static constexpr std::uint32_t largest = 0xffffffff;

  std::uint32_t ticks() const { return machine_time_low; }
};

}  // namespace sonoglide::hal::riscv_virt
