// However the image ends, both legs of the bridge are low. The watchdog then resets the board.
#include "hal/start/image_end.hpp"

#include <cstdint>

#include "hal/nucleo_g474re/control_registers.hpp"

namespace {

using namespace sonoglide::hal::nucleo_g474re;

constexpr std::uint32_t legs_low = 1U << (16 + 8) | 1U << (16 + 10);
constexpr std::uint32_t modes_of_legs = 3U << 16 | 3U << 20;
constexpr std::uint32_t outputs = 1U << 16 | 1U << 20;

}  // namespace

extern "C" {

void shutdown() {
  carrier_timer.break_control = outputs_off;
  port_a.set_and_reset = legs_low;
  port_a.mode = (port_a.mode & ~modes_of_legs) | outputs;
}

void leave_image(int /*code*/) {
  for (;;) {
    shutdown();
  }
}

void take_exception() {
  leave_image(0);
}

}  // extern "C"
