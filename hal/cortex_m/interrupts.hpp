/// Interrupts of a board with a Cortex-M. The handler of one is a function that the image defines for it, or one
/// that it names at run time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::cortex_m {

/// That the board has; where it does not say, that a processor of this architecture has at most.
#if defined(SONOGLIDE_INTERRUPTS)
#elif defined(__ARM_ARCH_6M__)
#define SONOGLIDE_INTERRUPTS 32
#elif defined(__ARM_ARCH_8M_MAIN__)
#define SONOGLIDE_INTERRUPTS 480
#else
#define SONOGLIDE_INTERRUPTS 240
#endif
inline constexpr std::size_t interrupts = SONOGLIDE_INTERRUPTS;

/// Lets an interrupt come. Its handler is `extern "C" void take_interrupt_<number>()`, which the image defines; one
/// that it does not define is an exception like others (take_exception). An image that calls this has a vector for
/// each interrupt of the board; in any other image there is none.
///
/// Source: Arm, ARMv6-M, ARMv7-M and ARMv8-M Architecture Reference Manuals, NVIC_ISER and NVIC_IPR.
///
/// @param number    below interrupts
/// @param priority  0 interrupts all others. Of its bits the processor has the upper ones, two at least: 0x40, 0x80
///                  and 0xc0 are lower ones everywhere
void enable_interrupt(std::size_t number, std::uint8_t priority);

namespace detail {

inline constexpr std::size_t exceptions_of_processor = 16;
inline constexpr std::size_t vectors = exceptions_of_processor + interrupts;

/// A vector table begins at a multiple of its size, rounded up to a power of two.
constexpr std::size_t table_alignment() {
  std::size_t alignment = 128;
  while (alignment < 4 * vectors) {
    alignment *= 2;
  }
  return alignment;
}

alignas(table_alignment()) inline std::uint32_t vectors_in_memory[vectors];

extern "C" {
// Of the image, from sections.ld.
extern const std::uint32_t vectors_begin[];
extern const std::uint32_t vectors_end[];
}

inline void let_come(std::size_t number) {
  auto* const enable = reinterpret_cast<volatile std::uint32_t*>(0xE000E100);
  enable[number / 32] = 1U << (number % 32);
}

}  // namespace detail

/// Calls a function at one interrupt of the board, from now on: the image then has its vectors in RAM. Whatever else
/// there are handlers for stays as it is. Not for a Cortex-M0, whose vectors are where they are.
///
/// Source: Arm, ARMv7-M and ARMv8-M Architecture Reference Manuals, VTOR.
///
/// @param number  of the interrupt, below interrupts
inline void take_interrupt(std::size_t number, void (*handler)()) {
  auto& vector_table_offset = *reinterpret_cast<volatile std::uint32_t*>(0xE000ED08);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the processor tells an address
  const auto* const old = reinterpret_cast<const volatile std::uint32_t*>(
      static_cast<std::uintptr_t>(vector_table_offset));
  auto& vectors = detail::vectors_in_memory;
  if (old != vectors) {
    // The table may be seen at another address than that at which it was linked.
    const auto linked = static_cast<std::size_t>(detail::vectors_end - detail::vectors_begin);
    for (std::size_t i = 0; i < detail::vectors; ++i) {
      vectors[i] = old[i < linked ? i : 3];  // the hard fault's
    }
  }
  vectors[detail::exceptions_of_processor + number] =
      static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(handler));
  asm volatile("" : : : "memory");
  vector_table_offset = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(vectors));
  detail::let_come(number);
}

}  // namespace sonoglide::hal::cortex_m
