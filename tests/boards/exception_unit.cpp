// A unit that drives, says so, and then does what no processor can: it is looked at what its
// exception handler leaves of the drive, and after a reset at the exception that was kept.
#include SONOGLIDE_BOARD_HEADER

#include <cstdint>

#include "controller_configuration.hpp"
#include "firmware/app/supervisor.hpp"
#include "firmware/app/timed_loop.hpp"
#include "hal/kept_exception.hpp"
#include "hal/no_watchdog.hpp"
#include "hal/timed/board.hpp"
#include "hal/timed/drive_register.hpp"
#include "send_number.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
using sonoglide::image_test::send;
namespace app = sonoglide::app;
namespace configuration = app::configuration;

constexpr double period_ticks = sonoglide::hal::timed::loop_period_s<Hardware>(
                                    configuration::carrier_period_s, configuration::every_periods) *
                                    Hardware::Board::clock_hz +
                                0.5;
constexpr int settled = 300;  // carrier periods

/// Nothing but an instruction that there is not; in RAM.
[[gnu::naked, gnu::noinline, gnu::section(".ramfunc")]] void trap() {
#if defined(__riscv)
  asm volatile("unimp");
#else
  asm volatile("udf #0");
#endif
}

std::uint32_t address_of(const volatile void* object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object));
}

/// What was kept, in a line, and whether it was taken for good.
void tell(Hardware::ByteLink& bytes, const sonoglide::hal::KeptException& kept) {
  send(bytes, kept.exception, ' ');
  send(bytes, kept.program_counter, ' ');
  send(bytes, kept.program_status, ' ');
  send(bytes, kept.fault_status, ' ');
  send(bytes, sonoglide::hal::take_kept_exception() != nullptr ? 1 : 0, '\n');
}

}  // namespace

int main() {
  Hardware::ByteLink bytes;
  if (const auto* kept = sonoglide::hal::take_kept_exception()) {
    tell(bytes, *kept);
    return 0;
  }
  Hardware::Board board(static_cast<std::uint32_t>(period_ticks));
  app::Supervisor<sonoglide::control::Controller<configuration::Parts>> supervisor(
      configuration::parameters);
  supervisor.set_target(app::first_target(configuration::target_steps));
  sonoglide::hal::NoWatchdog watchdog;
  app::NoService service;
  app::TimedLoop loop(supervisor, board, watchdog, service);
  for (int i = 0; i < settled; ++i) {
    loop.serve();
  }
  send(bytes, address_of(&drive_amplitude), ' ');
  send(bytes, static_cast<std::uint32_t>(drive_amplitude), ' ');
  constexpr std::uint32_t without_thumb_bit = ~std::uint32_t{1};
  send(bytes,
       static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&trap)) & without_thumb_bit,
       '\n');
  trap();
}
