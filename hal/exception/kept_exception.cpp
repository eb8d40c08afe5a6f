#include "hal/kept_exception.hpp"

#include <cstdint>

#include "hal/reset_cause.hpp"
#include "hal/start/image_end.hpp"

namespace sonoglide::hal {
namespace {

struct Record {
  KeptException exception;
  std::uint32_t check;  ///< of the exception; after power-on anything may stand here
};

[[gnu::section(".noinit")]] Record record;
[[gnu::section(".noinit.mark")]] std::uint32_t mark;  ///< apart: in images that ask for it alone

/// FNV-1a over the words. Out of line, for fewer bytes: it is needed three times.
[[gnu::noinline]] std::uint32_t check_of(const KeptException& exception) {
  std::uint32_t hash = 0x811c9dc5;
  for (const std::uint32_t word : words_of(exception)) {
    hash = (hash ^ word) * 0x01000193;
  }
  return hash;
}

bool is_whole() {
  return record.check == check_of(record.exception);
}

/// Unless one is kept: what comes after the first one may be its consequence.
void keep(const KeptException& exception) {
  if (!is_whole()) {
    record = {exception, check_of(exception)};
  }
}

}  // namespace

const KeptException* take_kept_exception() {
  if (!is_whole()) {
    return nullptr;
  }
  record.check = ~record.check;
  return &record.exception;
}

bool ram_was_kept() {
  constexpr std::uint32_t there = 0x5EA1ED3A;
  const bool kept = mark == there;
  mark = there;
  return kept;
}

}  // namespace sonoglide::hal

extern "C" {

#if defined(__riscv)

// Naked, on a stack that is begun anew: what is on the old one is not needed.
// Source: RISC-V International, Privileged Architecture, machine trap handling.
[[gnu::naked, gnu::section(".kept"), gnu::used, noreturn]] void keep_exception() {
  asm volatile(
      "mv s0, ra \n"
      "call shutdown \n"
      "mv a0, s0 \n"
      "la sp, stack_top \n"
      "call write_exception \n"
      "call take_exception \n");
}

[[gnu::used]] void write_exception(std::uint32_t return_address) {
  sonoglide::hal::KeptException exception{};
  exception.link_register = return_address;
  asm volatile("csrr %0, mcause" : "=r"(exception.exception));
  asm volatile("csrr %0, mepc" : "=r"(exception.program_counter));
  asm volatile("csrr %0, mstatus" : "=r"(exception.program_status));
  asm volatile("csrr %0, mtval" : "=r"(exception.fault_address));
  sonoglide::hal::keep(exception);
}

#elif defined(__thumb__)

// Naked: there may be no stack. The frame is read only where it lies in RAM; then the stack is begun anew.
// Source: Arm, ARMv6-M, ARMv7-M and ARMv8-M Architecture Reference Manuals, exception entry.
[[gnu::naked, gnu::section(".kept"), gnu::used, noreturn]] void keep_exception() {
  asm volatile(
      ".syntax unified \n"
      "mov r4, lr \n"
      "bl shutdown \n"
      "mrs r3, msp \n"
      "lsrs r4, r4, #3 \n"  // bit 2 of the exception's return: on which stack the frame is
      "bcc 1f \n"
      "mrs r3, psp \n"
      "1: movs r0, #0 \n"
      "movs r1, #0 \n"
      "movs r2, #0 \n"
      "ldr r5, =stack_top \n"
      "lsls r4, r3, #30 \n"
      "bne 2f \n"
      "ldr r4, =ram_begin \n"
      "cmp r3, r4 \n"
      "blo 2f \n"
      "mov r4, r5 \n"
      "subs r4, #32 \n"
      "cmp r3, r4 \n"
      "bhi 2f \n"
      "ldr r0, [r3, #24] \n"
      "ldr r1, [r3, #20] \n"
      "ldr r2, [r3, #28] \n"
      "2: mov sp, r5 \n"
      "bl write_exception \n"
      "bl take_exception \n");
}

[[gnu::used]] void write_exception(std::uint32_t program_counter, std::uint32_t link_register,
                                   std::uint32_t program_status) {
  sonoglide::hal::KeptException exception{};
  asm volatile("mrs %0, ipsr" : "=r"(exception.exception));
  exception.program_counter = program_counter;
  exception.link_register = link_register;
  exception.program_status = program_status;
#if __ARM_ARCH_ISA_THUMB == 2 && !defined(__ARM_ARCH_8M_BASE__)
  const auto* const faults = reinterpret_cast<const volatile std::uint32_t*>(0xE000ED28);
  constexpr std::uint32_t memory_address_valid = 1U << 7;
  constexpr std::uint32_t bus_address_valid = 1U << 15;
  exception.fault_status = faults[0];
  exception.hard_fault_status = faults[1];
  if ((exception.fault_status & bus_address_valid) != 0) {
    exception.fault_address = faults[4];
  } else if ((exception.fault_status & memory_address_valid) != 0) {
    exception.fault_address = faults[3];
  }
#endif
  sonoglide::hal::keep(exception);
}

#endif

}  // extern "C"
