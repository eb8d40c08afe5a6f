// Source: ST, RM0440, TIM1/TIM8/TIM20 (centre-aligned and combined PWM, break function, synchronisation), ADC
// (calibration, dual regular simultaneous mode, analog watchdog 1), DMAMUX and SYSCFG_CFGR2; inputs and
// alternate functions from the tables of the STM32G474 datasheet.
#include <cstddef>
#include <cstdint>

#include "hal/cortex_m/interrupts.hpp"
#include "hal/nucleo_g474re/board.hpp"
#include "hal/nucleo_g474re/transfers.hpp"
#include "hal/start/image_end.hpp"

namespace sonoglide::hal::nucleo_g474re {
namespace {

struct PairRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t results;
};

// Addresses from memory.ld.
extern "C" {
extern PairRegisters pair_of_converters;  // of force and velocity
extern volatile std::uint32_t clock_of_vibration_converter;
extern volatile std::uint32_t system_faults;
}

constexpr std::uint32_t clocks_of_timers_and_faults = 1U << 0 | 1U << 11 | 1U << 13;
constexpr std::uint32_t clocks_of_converters = 1U << 13 | 1U << 14;
/// Lock-up of the processor, a parity error of the RAM, a flash error: each makes the legs low.
constexpr std::uint32_t breaking_faults = 1U << 0 | 1U << 1 | 1U << 3;

constexpr std::uint32_t counting = 1U << 0;
constexpr std::uint32_t up_and_down = 3U << 5;
constexpr std::uint32_t counting_down = 1U << 4;
constexpr std::uint32_t reload_at_update = 1U << 7;
constexpr std::uint32_t update_now = 1U << 0;
constexpr std::uint32_t tells_updates = 2U << 4;
constexpr std::uint32_t tells_first_compare = 4U << 4;
constexpr std::uint32_t set_back_and_started = 1U << 16;  // by the timer at its first input, TIM1

// Of two channels: compare values in force at the update; the first one is high below its compare value, or where
// the second one is.
constexpr std::uint32_t first_or_second = 1U << 3 | 1U << 16 | 4U << 4 | 1U << 11 | 7U << 12;
constexpr std::uint32_t high_from_compare_on = 7U << 4;
constexpr std::uint32_t outputs_1_and_3 = 1U << 0 | 1U << 8;

constexpr std::uint32_t converter_clocks = 4;  // system clocks in one of the converters
constexpr std::uint32_t synchronous = 3U << 16;
constexpr std::uint32_t both_at_once = 6U;
constexpr std::uint32_t carried_in_pairs = 1U << 13 | 2U << 14;
constexpr std::uint32_t regulated = 1U << 28;
constexpr std::uint32_t calibrating = 1U << 31;
constexpr std::uint32_t enabled = 1U << 0;
constexpr std::uint32_t ready = 1U << 0;
constexpr std::uint32_t converting = 1U << 2;
constexpr std::uint32_t without_injected = 1U << 31;
constexpr std::uint32_t watched = 1U << 23;
constexpr std::uint32_t triggered_by_sampling_timer = 7U << 5 | 1U << 10;
constexpr std::uint32_t carried = 1U << 0 | 1U << 1;
constexpr std::uint32_t highest_sound_code = 4094;
constexpr std::uint32_t lowest_sound_code = 1;

/// 12.5 clocks of the converters; a trigger is taken 2.125 of them later (datasheet).
constexpr std::uint32_t sampling_time = 2;
constexpr std::uint32_t clocks_until_held = (12500 + 2125) * converter_clocks / 1000;

constexpr std::uint32_t request_of_pair = 5;
constexpr std::uint32_t request_of_vibration = 37;
constexpr std::uint32_t carrier_interrupt = 25;

void wait_microseconds(std::uint32_t time) {
  for (std::uint32_t i = 0; i < time * (system_hz / 1000000); ++i) {
    asm volatile("");
  }
}

void prepare(ConverterRegisters& converter, std::uint32_t input) {
  converter.control = 0;
  converter.control = regulated;
  wait_microseconds(20);
  converter.control = regulated | calibrating;
  while ((converter.control & calibrating) != 0) {
  }
  wait_microseconds(1);
  converter.sampling_times[input / 10] = sampling_time << (3 * (input % 10));
  converter.sequence[0] = input << 6;
  converter.thresholds[0] = highest_sound_code << 16 | lowest_sound_code;
}

void enable(ConverterRegisters& converter, std::uint32_t configuration) {
  converter.configuration = without_injected | watched | configuration;
  converter.status = ready;
  converter.control = regulated | enabled;
  while ((converter.status & ready) == 0) {
  }
}

void start_conversions() {
  clock_control.ahb2_enable = clock_control.ahb2_enable | clocks_of_converters;
  pair_of_converters.control = synchronous;
  clock_of_vibration_converter = synchronous;
  prepare(force_converter, 1);
  prepare(velocity_converter, 2);
  prepare(vibration_converter, 12);
  pair_of_converters.control = synchronous | both_at_once | carried_in_pairs;
  enable(force_converter, triggered_by_sampling_timer);
  enable(velocity_converter, 0);
  enable(vibration_converter, triggered_by_sampling_timer | carried);
  start_transfer(0, request_of_pair, &pair_of_converters.results, pairs, 2 * conversions_in_period,
                 of_32_bits);
  start_transfer(1, request_of_vibration, &vibration_converter.result, vibration,
                 2 * conversions_in_period, of_16_bits);
  force_converter.control = regulated | converting;
  vibration_converter.control = regulated | converting;
}

}  // namespace

extern "C" {
std::uint32_t pairs[2][conversions_in_period];
std::uint16_t vibration[2][conversions_in_period];
}

Board::Board(std::uint32_t period_ticks)
    : half_period_(period_ticks / 2), half_of_start_(static_cast<float>(half_period_)) {
  enable_clocks();
  clock_control.apb2_enable = clock_control.apb2_enable | clocks_of_timers_and_faults;
  system_faults = breaking_faults;
  use_pin(port_a, 6, 6, pulled_down);  // an open line is a fault
  use_pin(port_a, 8, 6, pulled_down);
  use_pin(port_a, 10, 6, pulled_down);

  carrier_timer.control_1 = up_and_down | reload_at_update;
  carrier_timer.control_2 = tells_updates;
  carrier_timer.reload = half_period_;
  carrier_timer.repetitions = 1;  // an update at 0, not at the top
  carrier_timer.compare_mode[0] = first_or_second;
  carrier_timer.compare_mode[1] = first_or_second;
  carrier_timer.outputs = outputs_1_and_3;
  carrier_timer.break_control = outputs_off;
  put(0, half_period_);
  carrier_timer.generate = update_now;

  // Only once both timers are set: the update above would start the conversions.
  const std::uint32_t between = clocks_between_conversions(half_period_);
  sampling_timer.control_1 = reload_at_update;
  sampling_timer.control_2 = tells_first_compare;
  sampling_timer.reload = between - 1;
  sampling_timer.compare_mode[0] = high_from_compare_on;
  sampling_timer.compare[0] = between / 2 - clocks_until_held;
  sampling_timer.generate = update_now;
  start_conversions();
  sampling_timer.slave_mode = set_back_and_started;

  carrier_timer.status = 0;  // of a break too, which a line that was not its pin yet has made
  carrier_timer.control_1 = counting | up_and_down | reload_at_update;
  while ((carrier_timer.status & update_event) == 0) {
  }
  if ((carrier_timer.control_1 & counting_down) != 0) {
    leave_image(1);
  }
  carrier_timer.status = ~update_event;
}

void Board::interrupt() {
  cortex_m::take_interrupt(carrier_interrupt, take_carrier);
  carrier_timer.interrupting = update_event;
}

}  // namespace sonoglide::hal::nucleo_g474re
