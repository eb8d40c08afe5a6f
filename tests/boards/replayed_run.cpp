// The unit of a scene on a board's own timer, in the period of its steps. In the place of a contact there are
// the samples that it meets on the workstation: its commands are the same, or a line says so.
#include SONOGLIDE_BOARD_HEADER

#include <cstddef>
#include <cstdint>

#include "controller_configuration.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/unit.hpp"
#include "hal/no_watchdog.hpp"
#include "hal/timed/board.hpp"
#include "hal/timed/volatile_pages.hpp"
#include "hal/trace_hash.hpp"
#include "recorded_run.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
namespace app = sonoglide::app;
namespace configuration = app::configuration;
namespace hal = sonoglide::hal;
namespace recorded = sonoglide::recorded;

/// Whatever the drive does. The first period is that of the restart, whose sample nobody looks at.
class RecordedContact {
 public:
  static void drive(std::int32_t /*amplitude*/) {}
  void live() { ++begun_; }
  auto sample() const { return recorded::samples[begun_ < 2 ? 0 : begun_ - 2]; }

 private:
  std::size_t begun_ = 0;
};

template <class Board>
struct WithRecordedContact;
template <class Clock>
struct WithRecordedContact<hal::timed::Board<Clock>> {
  using Board = hal::timed::Board<Clock, RecordedContact>;
};
using Board = WithRecordedContact<Hardware::Board>::Board;

constexpr double period_s = hal::timed::loop_period_s<Hardware>(configuration::carrier_period_s,
                                                                configuration::every_periods);
constexpr app::FieldDesign<configuration::Parts> design(
    configuration::parameters, app::first_target(configuration::target_steps),
    configuration::design, configuration::full_scales, period_s, 0);

}  // namespace

int main() {
  Hardware::ByteLink bytes;
  hal::timed::VolatilePages flash;
  app::Unit unit(design, flash);
  auto& supervisor = unit.supervisor();
  hal::NoWatchdog watchdog;
  app::NoService service;
  Board board(static_cast<std::uint32_t>(period_s * Board::clock_hz + 0.5));
  app::TimedLoop loop(supervisor, board, watchdog, service);
  unit.restart(0);
  loop.serve();
  auto targets = app::schedule_of(configuration::target_steps);
  hal::TraceHash hash;
  for (std::size_t i = 0; i < sizeof recorded::samples / sizeof recorded::samples[0]; ++i) {
    targets.advance(supervisor);
    loop.serve();
    hash.add(supervisor.drive());
  }
  const char* const line =
      hash.value() == recorded::trace_hash ? "the same commands\n" : "other commands\n";
  for (const char* character = line; *character != '\0'; ++character) {
    while (!bytes.send(static_cast<std::uint8_t>(*character))) {
    }
  }
  return 0;
}
