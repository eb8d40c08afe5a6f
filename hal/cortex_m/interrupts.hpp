/// Interrupts of a board with a Cortex-M.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::cortex_m {

namespace detail {

inline constexpr std::size_t exceptions_of_processor = 16;

/// A vector table begins at a multiple of its size, rounded up to a power of two.
constexpr std::size_t table_alignment(std::size_t words) {
  std::size_t alignment = 128;
  while (alignment < 4 * words) {
    alignment *= 2;
  }
  return alignment;
}

template <std::size_t Interrupts>
struct VectorsInMemory {
  static constexpr std::size_t words = exceptions_of_processor + Interrupts;
  alignas(table_alignment(words)) static inline std::uint32_t vectors[words];
};

}  // namespace detail

/// Calls a function at one interrupt of the board, from now on. Every other interrupt is an exception, and the
/// exceptions stay what they are.
///
/// Source: Arm, ARMv6-M, ARMv7-M and ARMv8-M Architecture Reference Manuals, VTOR and NVIC_ISER.
///
/// @tparam Interrupts  that the board has
/// @param number       of the interrupt, below Interrupts
template <std::size_t Interrupts>
void take_interrupt(std::size_t number, void (*handler)()) {
  auto& vector_table_offset = *reinterpret_cast<volatile std::uint32_t*>(0xE000ED08);
  auto* const enable = reinterpret_cast<volatile std::uint32_t*>(0xE000E100);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the processor tells an address
  const auto* const old = reinterpret_cast<const volatile std::uint32_t*>(
      static_cast<std::uintptr_t>(vector_table_offset));
  auto& vectors = detail::VectorsInMemory<Interrupts>::vectors;
  for (std::size_t i = 0; i < detail::exceptions_of_processor; ++i) {
    vectors[i] = old[i];
  }
  for (std::size_t i = 0; i < Interrupts; ++i) {
    vectors[detail::exceptions_of_processor + i] = old[3];  // the hard fault's
  }
  vectors[detail::exceptions_of_processor + number] =
      static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(handler));
  asm volatile("" : : : "memory");
  vector_table_offset = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(vectors));
  enable[number / 32] = 1U << (number % 32);
}

}  // namespace sonoglide::hal::cortex_m
