/// Memory that a peripheral fills, in rings, by DMA1.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/nucleo_g474re/control_registers.hpp"

namespace sonoglide::hal::nucleo_g474re {

/// Source: ST, RM0440, DMA registers.
struct ChannelRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t count;  ///< left until the ring is full
  volatile std::uint32_t peripheral;
  volatile std::uint32_t memory;
  std::uint32_t reserved;
};

// Addresses from memory.ld.
extern "C" {
extern ChannelRegisters transfers[8];
extern volatile std::uint32_t transfer_requests[8];  ///< DMAMUX1: one of each channel
}

inline constexpr std::uint32_t of_8_bits = 0;
inline constexpr std::uint32_t of_16_bits = 1U << 8 | 1U << 10;
inline constexpr std::uint32_t of_32_bits = 2U << 8 | 2U << 10;

inline void enable_clocks() {
  constexpr std::uint32_t transfers_and_their_requests = 1U << 0 | 1U << 2;
  constexpr std::uint32_t ports_a_and_b = 3;
  clock_control.ahb1_enable = clock_control.ahb1_enable | transfers_and_their_requests;
  clock_control.ahb2_enable = clock_control.ahb2_enable | ports_a_and_b;
}

inline void start_transfer(std::size_t channel, std::uint32_t request, const volatile void* from,
                           const volatile void* to, std::size_t count, std::uint32_t size) {
  constexpr std::uint32_t enabled = 1U << 0;
  constexpr std::uint32_t in_a_ring = 1U << 5;
  constexpr std::uint32_t to_next_address = 1U << 7;
  const auto address = [](const volatile void* object) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object));
  };
  transfer_requests[channel] = request;
  transfers[channel].peripheral = address(from);
  transfers[channel].memory = address(to);
  transfers[channel].count = static_cast<std::uint32_t>(count);
  transfers[channel].control = enabled | in_a_ring | to_next_address | size;
}

}  // namespace sonoglide::hal::nucleo_g474re
