// The unit of one scene on a board whose carrier interrupts: control in the interrupt, the link to the host
// in what time is left.
#include SONOGLIDE_BOARD_HEADER

#include <cstdint>

#include "controller_configuration.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/history.hpp"
#include "firmware/app/identity.hpp"
#include "firmware/app/link_service.hpp"
#include "firmware/app/self_test.hpp"
#include "firmware/app/sequence_lock.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/unit.hpp"
#include "firmware/image/carrier/carrier_board.hpp"
#include "hal/kept_exception.hpp"
#include "hal/reset_cause.hpp"
#include "hal/start/image_end.hpp"
#include "hal/start/stored_image.hpp"
#include "hal/trace_records.hpp"

namespace {

using Hardware = SONOGLIDE_BOARD_CLASS;
namespace app = sonoglide::app;
namespace configuration = app::configuration;
using CarrierBoard =
    sonoglide::image::BoardOf<Hardware, decltype(configuration::target_steps)>::Type;

constexpr std::uint32_t ticks =
    sonoglide::image::CarrierTicks<configuration::Parts, CarrierBoard, configuration::every_periods,
                                   configuration::delay_periods, configuration::interpolates,
                                   app::tuned>::of(configuration::carrier_period_s);
static_assert(ticks != 0,
              "this board cannot make drive.frequency_Hz; its README lists those it can");

constexpr app::FieldDesign<configuration::Parts> design(
    configuration::parameters, app::first_target(configuration::target_steps),
    configuration::design, configuration::full_scales, configuration::step_period_s,
    app::default_timeout_ms);

using History = app::HistoryOn<Hardware::Flash>;

constexpr auto periods_per_second =
    static_cast<std::uint32_t>(1.0 / configuration::step_period_s + 0.5);
static_assert(!History::kept || periods_per_second >= 1, "a history counts seconds");

struct Product : app::Unnamed {
  static constexpr const char* board = SONOGLIDE_BOARD_NAME;
  static inline const sonoglide::hal::KeptException* exception = nullptr;
  static inline History::Pointer history = nullptr;
};

using Course = decltype(app::course_of<CarrierBoard>(configuration::target_steps));
using Unit = app::Unit<configuration::Parts, Hardware::Flash, app::InterruptedWord,
                       sonoglide::hal::trace_records<Hardware>, Course, app::ImageTest>;
using Service = app::LinkService<Unit, Hardware::ByteLink, 32, Product>;
using Loop = app::TimedLoop<Unit::Supervisor, CarrierBoard, Hardware::Watchdog, Service>;

Loop* loop;  // set before the carrier interrupts

}  // namespace

extern "C" void take_carrier() {
  loop->control();
}

// Whatever the carrier's interrupt does not do; a board whose fast memory is short keeps it elsewhere.
[[gnu::section(".text.service")]] int main() {
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
  Unit unit(design, flash, app::course_of<CarrierBoard>(configuration::target_steps), image_test);
  Service service(unit, bytes);
  CarrierBoard board(ticks);
  app::tune(board, configuration::carrier_period_s);
  if (!image_test.passed()) {
    shutdown();  // damaged code may write anything to the carrier
  }
  Loop own(unit.supervisor(), board, watchdog, service);
  loop = &own;
  CarrierBoard::interrupt();
  for (;;) {
    own.service();
  }
}
