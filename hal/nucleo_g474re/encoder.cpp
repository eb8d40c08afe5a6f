// Source: ST, RM0440, TIM2/TIM3/TIM4/TIM5 (encoder interface, input capture, internal trigger connection); pins from
// the alternate function table of the datasheet.
#include "hal/nucleo_g474re/encoder.hpp"

#include <cstdint>

#include "hal/nucleo_g474re/control_registers.hpp"

namespace sonoglide::hal::nucleo_g474re {

void start_encoder() {
  constexpr std::uint32_t clock_of_timer = 1U << 3;
  constexpr std::uint32_t clocks_of_ports_b_and_c = 3U << 1;
  // Of two channels: their own inputs, each level seen by eight clocks in turn.
  constexpr std::uint32_t both_filtered = 1U << 0 | 3U << 4 | 1U << 8 | 3U << 12;
  constexpr std::uint32_t third_by_trigger = 3U << 0;
  constexpr std::uint32_t captures_third = 1U << 8;
  // Every edge of either input counts; the trigger is the first one, TIM1.
  constexpr std::uint32_t counts_all_edges = 3U;
  constexpr std::uint32_t counting = 1U << 0;

  clock_control.ahb2_enable = clock_control.ahb2_enable | clocks_of_ports_b_and_c;
  clock_control.apb1_enable = clock_control.apb1_enable | clock_of_timer;
  use_pin(port_b, 2, 2, pulled_up);
  use_pin(port_c, 12, 1, pulled_up);
  encoder_timer.compare_mode[0] = both_filtered;
  encoder_timer.compare_mode[1] = third_by_trigger;
  encoder_timer.outputs = captures_third;
  encoder_timer.reload = 0xffffffffU;
  encoder_timer.slave_mode = counts_all_edges;
  encoder_timer.control_1 = counting;
}

}  // namespace sonoglide::hal::nucleo_g474re
