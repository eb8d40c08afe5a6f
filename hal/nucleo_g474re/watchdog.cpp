// Source: ST, RM0440, system window watchdog (WWDG); RCC_CSR.
#include "hal/nucleo_g474re/board.hpp"

namespace sonoglide::hal::nucleo_g474re {
namespace {

constexpr std::uint32_t watchdog_clock = 1U << 11;
constexpr std::uint32_t by_watchdog = 1U << 30;
constexpr std::uint32_t clear_causes = 1U << 23;
/// A tick of the watchdog: 4096 * 64 clocks, 1.56 ms; it resets after 64 of them.
constexpr std::uint32_t divided_by_64 = 6U << 11;

}  // namespace

Watchdog::Watchdog() : caused_reset_((clock_control.reset_status & by_watchdog) != 0) {
  clock_control.reset_status = clear_causes;
  clock_control.apb1_enable = clock_control.apb1_enable | watchdog_clock;
  watchdog.control = full;
  watchdog.window = divided_by_64 | latest;
}

}  // namespace sonoglide::hal::nucleo_g474re
