// A unit that drives, controlled in the interrupt of the system timer, and whose service hangs. The interrupt
// goes on, and says on the serial line what becomes of the drive; the watchdog ends it.
#include SONOGLIDE_BOARD_HEADER

#include <array>
#include <cstddef>
#include <cstdint>

#include "controller_configuration.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/unit.hpp"
#include "firmware/encoding/decimal.hpp"
#include "hal/cortex_m/sys_tick.hpp"
#include "hal/timed/board.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
namespace app = sonoglide::app;
namespace configuration = app::configuration;
namespace encoding = sonoglide::encoding;
namespace hal = sonoglide::hal;

constexpr double period_s = hal::timed::loop_period_s<Hardware>(configuration::carrier_period_s,
                                                                configuration::every_periods);
constexpr auto period_clocks = static_cast<std::uint32_t>(period_s * Hardware::Board::clock_hz);
constexpr std::uint32_t settled = 300;  // periods

constexpr app::FieldDesign<configuration::Parts> design(
    configuration::parameters, app::first_target(configuration::target_steps),
    configuration::design, configuration::full_scales, period_s, 0);
using Unit = app::Unit<configuration::Parts, Hardware::Flash>;

/// Each call of sample() is an interrupt that begins a period.
class InterruptedBoard {
 public:
  bool sample(hal::Sample& sample) {
    ++period_;
    contact_.drive(drive_amplitude);
    contact_.live();
    sample = contact_.sample();
    return true;
  }
  static void drive(const hal::Drive& drive) { drive_amplitude = drive.amplitude; }
  std::uint32_t period() const { return period_; }

 private:
  hal::timed::StandInContact contact_;
  volatile std::uint32_t period_ = 0;
};

struct Service {
  static void serve() {}
};
using Loop = app::TimedLoop<Unit::Supervisor, InterruptedBoard, Hardware::Watchdog, Service>;

Loop* loop;
Unit* unit;
Hardware::ByteLink* bytes;
bool told;

void send(const char* text) {
  for (; *text != '\0'; ++text) {
    while (!bytes->send(static_cast<std::uint8_t>(*text))) {
    }
  }
}

void tell(const char* word, std::uint32_t number) {
  std::array<char, encoding::most_decimal_characters + 1> text{};
  text[encoding::write_decimal(number, 0, text.data())] = '\0';
  send(word);
  send(text.data());
  send("\n");
}

}  // namespace

extern "C" void take_system_tick() {
  loop->control();
  const hal::Drive& drive = unit->supervisor().drive();
  if (!told && drive.fault == static_cast<std::uint8_t>(app::UnitFault::service_stalled)) {
    told = true;
    tell("stalled, drive ", static_cast<std::uint32_t>(drive_amplitude));
  }
}

int main() {
  Hardware::ByteLink own_bytes;
  Hardware::Watchdog watchdog;
  Hardware::Flash flash;
  Unit own_unit(design, flash);
  InterruptedBoard board;
  Service service;
  Loop own_loop(own_unit.supervisor(), board, watchdog, service);
  bytes = &own_bytes;
  unit = &own_unit;
  loop = &own_loop;
  own_unit.restart(0);
  hal::cortex_m::SysTick::interrupt_every(period_clocks);
  while (board.period() < settled) {
    own_loop.service();
  }
  tell("hangs, drive ", static_cast<std::uint32_t>(drive_amplitude));
  for (;;) {
  }
}
