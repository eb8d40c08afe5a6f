// The unit of one scene in lockstep with its host, and driving from the start: its commands, and what its control
// side takes in each period. Service and store are those of a product; nobody speaks to it.
#include SONOGLIDE_BOARD_HEADER

#include <cstdint>
#include <type_traits>

#include "controller_configuration.hpp"
#include "firmware/app/field_parameters.hpp"
#include "firmware/app/link_service.hpp"
#include "firmware/app/sequence_lock.hpp"
#include "firmware/app/target_schedule.hpp"
#include "firmware/app/texture.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/timed_targets.hpp"
#include "firmware/app/unit.hpp"
#include "hal/no_watchdog.hpp"
#include "hal/timed/volatile_pages.hpp"

namespace {

namespace app = sonoglide::app;
namespace configuration = app::configuration;
namespace hal = sonoglide::hal;

/// Keeps an answer until control() has ended, so that its board counts all of it.
template <class Sample, class Drive>
class CountedBoard {
 public:
  bool sample(Sample& sample) {
    ++period_;
    return lockstep_.sample(sample);
  }
  void drive(const Drive& drive) { answer_ = drive; }
  std::uint32_t period() const { return period_; }

  /// The answer to the sample, and the count.
  void send() { lockstep_.drive(answer_); }

 private:
  SONOGLIDE_BOARD_CLASS lockstep_;
  std::uint32_t period_ = 0;
  Drive answer_{};
};

struct SilentLink {
  static bool receive(std::uint8_t& /*byte*/) { return false; }
  static bool send(std::uint8_t /*byte*/) { return true; }
};

constexpr app::FieldDesign<configuration::Parts> design(
    configuration::parameters, app::first_target(configuration::target_steps),
    configuration::design, configuration::full_scales, configuration::step_period_s, 0);

using Course = decltype(app::course_of<void>(configuration::target_steps));
using Unit =
    app::Unit<configuration::Parts, hal::timed::VolatilePages, app::InterruptedWord, 0, Course>;

/// The next step has its target.
template <class Targets>
void advance(Targets& targets, Unit::Supervisor& supervisor) {
  if constexpr (std::is_same_v<Course, app::OrderedTargets>) {
    targets.advance(supervisor);
  }
}

}  // namespace

int main() {
  hal::timed::VolatilePages flash;
  SilentLink bytes;
  hal::NoWatchdog watchdog;
  Unit unit(design, flash, app::course_of<void>(configuration::target_steps));
  app::LinkService service(unit, bytes);
  auto& supervisor = unit.supervisor();
  using Supervisor = Unit::Supervisor;
  CountedBoard<Supervisor::Sample, Supervisor::Drive> board;
  app::TimedLoop loop(supervisor, board, watchdog, service);
  supervisor.restart();
  auto targets = app::schedule_of(configuration::target_steps);
  advance(targets, supervisor);
  while (loop.control()) {
    board.send();
    loop.service();
    advance(targets, supervisor);
  }
  return 0;
}
