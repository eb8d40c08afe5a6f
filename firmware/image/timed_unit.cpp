// The image of one scene's controller on a board that keeps its own time, with a link to its host
// on the serial line; both are chosen when the image is built.
#include SONOGLIDE_BOARD_HEADER

#include <cstdint>
#include <type_traits>

#include "controller_configuration.hpp"
#include "firmware/app/exchange.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/identity.hpp"
#include "firmware/app/link_service.hpp"
#include "firmware/app/sequence_lock.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/unit.hpp"
#include "hal/kept_exception.hpp"
#include "hal/serial_line.hpp"
#include "hal/timed/board.hpp"
#include "hal/trace_records.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
namespace app = sonoglide::app;
namespace configuration = app::configuration;

static_assert(!configuration::Parts::Vibration::observed,
              "an emulated board has no vibration for sensor.vibration; a board of a product fills "
              "hal::VibrationSample");

static_assert(!std::is_same_v<app::DriveOf<sonoglide::control::Controller<configuration::Parts>>,
                              sonoglide::hal::BiasedDrive>,
              "an emulated board has no output for a bias: leave out drive.bias_limit_N");

/// Of the loop; the carrier is derived from the same clock.
constexpr double period_s = sonoglide::hal::timed::loop_period_s<Hardware>(
    configuration::carrier_period_s, configuration::every_periods);

/// The time of an emulator is not that of the host: none would be a silence.
constexpr std::uint32_t timeout_ms = 0;

constexpr app::FieldDesign<configuration::Parts> design(
    configuration::parameters, app::first_target(configuration::target_steps),
    configuration::design, configuration::full_scales, period_s, timeout_ms);

struct Product : app::Unnamed {
  static constexpr const char* board = SONOGLIDE_BOARD_NAME;
  static inline const sonoglide::hal::KeptException* exception = nullptr;
};

using Course = decltype(app::course_of<Hardware::Board>(configuration::target_steps));

/// Its processor is the only one.
using Unit = app::Unit<configuration::Parts, Hardware::Flash, app::InterruptedWord,
                       sonoglide::hal::trace_records<Hardware>, Course>;

/// To the nearest tick.
constexpr double period_ticks = period_s * Hardware::Board::clock_hz + 0.5;
static_assert(1.0 <= period_ticks && period_ticks <= Hardware::Board::most_period_ticks,
              "the timer of this board cannot make drive.frequency_Hz");

}  // namespace

int main() {
  Product::exception = sonoglide::hal::take_kept_exception();
  Hardware::ByteLink bytes;
  Hardware::Watchdog watchdog;
  Hardware::Flash flash;
  Unit unit(design, flash, app::course_of<Hardware::Board>(configuration::target_steps));
  app::LinkService<Unit, Hardware::ByteLink,
                   sonoglide::hal::bytes_in(Hardware::ByteLink::baud, period_s), Product>
      service(unit, bytes);
  Hardware::Board board(static_cast<std::uint32_t>(period_ticks));
  app::TimedLoop loop(unit.supervisor(), board, watchdog, service);
  while (loop.serve()) {
  }
  return 0;
}
