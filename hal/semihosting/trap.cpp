#include "hal/semihosting/semihosting.hpp"

// Naked: operation and parameters stand in the registers that the call wants, and the answer in
// that of a result.
namespace sonoglide::hal::semihosting {

#if defined(__riscv)
// Source: RISC-V Semihosting, version 0.4: three instructions, uncompressed, on one page.
[[gnu::naked, gnu::aligned(16)]] std::int32_t trap(std::int32_t, const std::uintptr_t*) {
  asm volatile(
      ".option push \n"
      ".option norvc \n"
      "slli x0, x0, 0x1f \n"
      "ebreak \n"
      "srai x0, x0, 7 \n"
      "ret \n"
      ".option pop \n");
}
#elif defined(__thumb__)
// Source: Arm, Semihosting for AArch32 and AArch64, release 2.0; M profile.
[[gnu::naked]] std::int32_t trap(std::int32_t, const std::uintptr_t*) {
  asm volatile(
      "bkpt 0xab \n"
      "bx lr \n");
}
#else
#error "No semihosting is known for this processor."
#endif

}  // namespace sonoglide::hal::semihosting
