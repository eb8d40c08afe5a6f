// From a board's reset to the program: runs from flash, starts the clocks and copies the program to RAM. The
// linker script of the board has boot_vectors where the processor looks for them after a reset.
#include "hal/cortex_m/loaded/load_program.hpp"

#include <cstdint>

namespace {

// Addresses from memory.ld.
extern "C" {
extern const std::uint32_t program_image[];
extern std::uint32_t program_begin[];
extern std::uint32_t program_end[];
extern std::uint32_t stack_top[];
void board_entry();
}

/// In place of the program's exception handlers. The pins are as after a reset: the drive is off.
[[gnu::section(".boot")]] void stay() {
  for (;;) {
  }
}

struct VectorTable {
  std::uint32_t* initial_stack;
  void (*board_entry)();
  void (*exceptions[14])();
};

}  // namespace

extern "C" {

// Through volatile, because a call to copy memory would lead to where nothing is yet.
[[gnu::section(".boot"), noreturn]] void load_program() {
  start_clocks();
  const volatile std::uint32_t* from = program_image;
  for (volatile std::uint32_t* to = program_begin; to != program_end; to = to + 1) {
    *to = *from;
    from = from + 1;
  }
  const volatile std::uint32_t* vectors = program_begin;
  auto& vector_table_offset = *reinterpret_cast<volatile std::uint32_t*>(0xE000ED08);
  vector_table_offset = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(vectors));
  asm volatile("msr msp, %0 \n bx %1 \n" : : "r"(vectors[0]), "r"(vectors[1]));
  __builtin_unreachable();
}

[[gnu::section(".boot_vectors")]] extern const VectorTable boot_vectors;
const VectorTable boot_vectors = {
    stack_top,
    board_entry,
    {stay, stay, stay, stay, stay, stay, stay, stay, stay, stay, stay, stay, stay, stay}};

}  // extern "C"
