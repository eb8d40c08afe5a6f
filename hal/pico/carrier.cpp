// Source: Raspberry Pi, RP2040 and RP2350 Datasheets, GPIO, pads, PWM, ADC, DMA.
#include <cstddef>
#include <cstdint>

#include "hal/cortex_m/interrupts.hpp"
#include "hal/pico/board.hpp"
#include "hal/pico/pins.hpp"
#include "hal/pico/resets.hpp"

namespace sonoglide::hal::pico {
namespace {

struct ConverterRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t result;
  volatile std::uint32_t queue_control;
  volatile std::uint32_t queue;
  volatile std::uint32_t divider;  // clocks in a conversion less one, with 8 fraction bits
};

struct ChannelRegisters {
  volatile std::uint32_t read_address;
  volatile std::uint32_t write_address;
  volatile std::uint32_t count;
  volatile std::uint32_t control_and_start;
  volatile std::uint32_t control;
  std::uint32_t aliases[11];
};
static_assert(sizeof(ChannelRegisters) == 0x40);

// Addresses from memory.ld.
extern "C" {
extern ConverterRegisters converter;
extern ChannelRegisters transfers[2];
}

constexpr std::uint32_t counting = 1U << 0;
constexpr std::uint32_t up_and_down = 1U << 1;
constexpr std::uint32_t second_output_inverted = 1U << 3;

constexpr std::uint32_t on = 1U << 0;
constexpr std::uint32_t converting = 1U << 3;
constexpr std::uint32_t ready = 1U << 8;
constexpr std::uint32_t first_two_inputs_in_turn = 3U << 16;
constexpr std::uint32_t conversions_queued = 1U << 0;
constexpr std::uint32_t failure_marked = 1U << 2;
constexpr std::uint32_t requesting = 1U << 3;
constexpr std::uint32_t one_is_enough = 1U << 24;

constexpr std::uint32_t channel_enabled = 1U << 0;
constexpr std::uint32_t of_16_bits = 1U << 2;

std::uint32_t address(const volatile void* object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object));
}

}  // namespace

extern "C" {
alignas(4 * pairs_in_period) volatile std::uint32_t conversions[2][pairs_in_period];
}

Board::Board(std::uint32_t period_ticks) : half_period_(period_ticks / 2) {
  release(reset_of_pins | reset_of_modulator | reset_of_converter | reset_of_transfers);
  carrier_slice.control = up_and_down | second_output_inverted;
  carrier_slice.divider = 1U << 4;
  carrier_slice.top = half_period_ - 1;
  carrier_slice.compare = pulses_of(0);
  carrier_slice.counter = 0;
  leave_to_converter(26);
  leave_to_converter(27);
  converter.control = on;
  while ((converter.control & ready) == 0) {
  }
  converter.queue_control = conversions_queued | failure_marked | requesting | one_is_enough;
  constexpr std::uint32_t system_MHz = system_hz / 1000000;
  constexpr std::uint32_t converter_MHz = converter_hz / 1000000;
  const std::uint32_t clocks = period_ticks * converter_MHz / (system_MHz * 2 * pairs_in_period);
  converter.divider = (clocks - 1) << 8;
  for (const std::uint32_t channel : {1U, 0U}) {
    transfers[channel].read_address = address(&converter.queue);
    transfers[channel].write_address = address(conversions[channel]);
    transfers[channel].count = 2 * pairs_in_period;
    const std::uint32_t control = channel_enabled | of_16_bits | to_next_address |
                                  in_ring_of_16_bytes | (1 - channel) << next_channel |
                                  at_request_of_converter;
    if (channel == 1) {
      transfers[channel].control = control;
    } else {
      transfers[channel].control_and_start = control;
    }
  }
  converter.control = on | converting | first_two_inputs_in_turn;
  while ((transfer_events.raw & 1U << 1) == 0) {  // the odd block: an even one is next
  }
  carrier_slice.control = counting | up_and_down | second_output_inverted;
  drive_pin(2, PinFunction::modulator);  // both outputs are low
  drive_pin(3, PinFunction::modulator);
  transfer_events.raw = 1U << 0 | 1U << 1;
  carrier_events.raw = slice_event;
}

void Board::interrupt() {
  cortex_m::take_interrupt(carrier_interrupt, take_carrier);
  carrier_events.interrupting = slice_event;
}

}  // namespace sonoglide::hal::pico
