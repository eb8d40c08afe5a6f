// The unit of one scene on a board that keeps its own time, with a link to its host; both are chosen when the image
// is built.
#include SONOGLIDE_BOARD_HEADER

#include <cstdint>
#include <type_traits>

#include "controller_configuration.hpp"
#include "firmware/app/exchange.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/history.hpp"
#include "firmware/app/identity.hpp"
#include "firmware/app/link_service.hpp"
#include "firmware/app/self_test.hpp"
#include "firmware/app/sequence_lock.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/unit.hpp"
#include "hal/kept_exception.hpp"
#include "hal/reset_cause.hpp"
#include "hal/serial_line.hpp"
#include "hal/start/image_end.hpp"
#include "hal/start/stored_image.hpp"
#include "hal/timed/board.hpp"
#include "hal/trace_records.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
namespace app = sonoglide::app;
namespace configuration = app::configuration;

using Controller = sonoglide::control::Controller<configuration::Parts>;
using Answer = app::DriveOf<Controller>;

/// Whether the board takes an answer as it is: one with a bias would pass for a plain one, without it.
template <class Board, class = void>
constexpr bool takes_answer = false;
template <class Board>
constexpr bool takes_answer<
    Board, std::void_t<decltype(static_cast<void (Board::*)(const Answer&)>(&Board::drive))>> =
    true;

constexpr bool serves =
    sonoglide::hal::keeps_periods<Hardware::Board, app::SampleOf<Controller>, Answer> &&
    takes_answer<Hardware::Board>;
static_assert(serves || !configuration::Parts::Vibration::observed,
              "this board has no vibration for sensor.vibration: it would fill "
              "hal::VibrationSample and take hal::ResonantDrive");
static_assert(serves || !std::is_same_v<Answer, sonoglide::hal::BiasedDrive>,
              "this board has no output for a bias: leave out drive.bias_limit_N");

/// Of the loop; the carrier is derived from the same clock.
constexpr double period_s = sonoglide::hal::timed::loop_period_s<Hardware>(
    configuration::carrier_period_s, configuration::every_periods);

using History = app::HistoryOn<Hardware::Flash>;

constexpr auto periods_per_second = static_cast<std::uint32_t>(1.0 / period_s + 0.5);
static_assert(!History::kept || periods_per_second >= 1, "a history counts seconds");

constexpr app::FieldDesign<configuration::Parts> design(
    configuration::parameters, app::first_target(configuration::target_steps),
    configuration::design, configuration::full_scales, period_s, Hardware::host_timeout_ms);

struct Product : app::Unnamed {
  static constexpr const char* board = SONOGLIDE_BOARD_NAME;
  static inline const sonoglide::hal::KeptException* exception = nullptr;
  static inline History::Pointer history = nullptr;
};

using Course = decltype(app::course_of<Hardware::Board>(configuration::target_steps));

/// Its processor is the only one.
using Unit = app::Unit<configuration::Parts, Hardware::Flash, app::InterruptedWord,
                       sonoglide::hal::trace_records<Hardware>, Course, app::ImageTest>;

/// To the nearest tick.
constexpr double period_ticks = period_s * Hardware::Board::clock_hz + 0.5;
static_assert(1.0 <= period_ticks && period_ticks <= Hardware::Board::most_period_ticks,
              "the timer of this board cannot make drive.frequency_Hz");

/// A board that makes a carrier has to know how many periods of it are in one of the loop.
constexpr bool takes_every_periods =
    std::is_constructible_v<Hardware::Board, std::uint32_t, unsigned>;
static_assert(configuration::every_periods == 1 || Hardware::least_periods > 1 ||
                  takes_every_periods,
              "this board takes a sample in every carrier period: leave out "
              "controller.every_periods, or let its constructor take them");

template <class Board>
Board make_board() {
  constexpr auto ticks = static_cast<std::uint32_t>(period_ticks);
  if constexpr (takes_every_periods) {
    return Board(ticks, configuration::every_periods);
  } else {
    return Board(ticks);
  }
}

}  // namespace

int main() {
  Product::exception = sonoglide::hal::take_kept_exception();
  const app::ImageTest image_test(sonoglide::hal::stored_image());  // before the watchdog runs
  Hardware::ByteLink bytes;
  Hardware::Watchdog watchdog;
  Hardware::Flash flash;
  sonoglide::hal::ResetCause cause{};
  if constexpr (History::kept) {
    cause = sonoglide::hal::reset_cause(watchdog, Product::exception);
  }
  History history(flash, watchdog, cause, Product::exception, periods_per_second);
  Product::history = history.pointer();
  Unit unit(design, flash, app::course_of<Hardware::Board>(configuration::target_steps),
            image_test);
  app::LinkService<Unit, Hardware::ByteLink,
                   sonoglide::hal::bytes_in(Hardware::ByteLink::baud, period_s), Product>
      service(unit, bytes);
  auto board = make_board<Hardware::Board>();
  if (!image_test.passed()) {
    shutdown();  // damaged code may write anything to the carrier
  }
  app::TimedLoop loop(unit.supervisor(), board, watchdog, service);
  while (loop.serve()) {
  }
  return 0;
}
