// Retired instructions of a RISC-V hart. Source: RISC-V International, Privileged Architecture,
// hardware performance monitor.
#include "hal/start/counter.hpp"

extern "C" {

void start_counter() {
  asm volatile("csrci mcountinhibit, 4");  // bit 2: the retired instructions
}

std::uint32_t read_counter() {
  std::uint32_t count = 0;
  asm volatile("csrr %0, minstret" : "=r"(count));
  return count;
}

}  // extern "C"
