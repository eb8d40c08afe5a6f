/// The loop of a unit whose carrier periods come from its board's own timer.
#pragma once

#include <cstdint>

#include "firmware/app/supervisor.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

/// Nothing to do beside control.
struct NoService {
  static void serve() {}
};

/// Two calls that may interrupt each other in one direction: control(), once in each carrier period from
/// the carrier's interrupt, and service(), again and again from main. Where there is time enough for
/// both, serve() calls one after the other. Each carrier period: sample, step, drive, feed the watchdog.
///
/// - An overrun is a step that is not done when the next period begins, or a period that passed
///   without a sample, while the unit drives. The amplitude would come into force late; it is
///   replaced by zero, and the fault stays until a restart.
/// - The watchdog is fed only when a period's step was done in time and the service comes round. This
///   holds in a fault too: otherwise the reset would be a restart that nobody asked for.
/// - A board that says that it has tripped (tripped()) holds the unit in the fault external, with the drive at
///   zero, and after that it needs a restart.
/// - After a reset by the watchdog the unit waits in a fault. After any other reset a unit without
///   a host runs (NoHost); one with a host does as its Unit decided.
///
/// @tparam Board     see hal/board.hpp: sample, drive and period.
/// @tparam Watchdog  see there; hal::NoWatchdog is none.
/// @tparam Service   a class with serve(), which does a bounded piece of work without waiting:
///                   LinkService; NoService is none.
template <class SupervisorT, class Board, class Watchdog, class Service>
class TimedLoop {
  using Sample = typename SupervisorT::Sample;
  static_assert(hal::keeps_periods<Board, Sample, typename SupervisorT::Drive>,
                "a board on its own timer has sample(), drive() and period(): see hal/board.hpp");

 public:
  TimedLoop(SupervisorT& supervisor, Board& board, Watchdog& watchdog, Service& service)
      : supervisor_(supervisor), board_(board), watchdog_(watchdog), service_(service) {
    if (watchdog_.caused_reset()) {
      supervisor_.trip(UnitFault::watchdog_reset);
    } else if constexpr (SupervisorT::drives_from_power_on) {
      supervisor_.restart();
    }
  }

  /// Serves one carrier period; false when the board shuts down.
  bool control() {
    Sample sample{};
    if (!board_.sample(sample)) {
      return false;
    }
    supervisor_.calibrate(sample);
    const std::uint32_t period = board_.period();
    // After drive(), so that a command which came just too late is replaced before it acts.
    if constexpr (hal::reports_trips<Board>) {
      const std::uint8_t cause = board_.tripped();
      board_.drive(cause != 0 ? supervisor_.hold(sample, cause) : supervisor_.step(sample));
    } else {
      board_.drive(supervisor_.step(sample));
    }
    const bool none_lost = !begun_ || period == period_ + 1;
    const bool in_time = none_lost && board_.period() == period;
    begun_ = true;
    period_ = period;
    if (in_time) {
      if (supervisor_.serviced()) {
        watchdog_.feed();
      }
    } else if (supervisor_.driving()) {
      supervisor_.trip(UnitFault::overrun);
      board_.drive(supervisor_.drive());
    }
    supervisor_.pass(sample, board_);
    supervisor_.publish();
    return true;
  }

  /// A bounded piece of work beside control.
  void service() {
    service_.serve();
    supervisor_.note_service();
  }

  /// Both, one after the other; false when the board shuts down.
  bool serve() {
    if (!control()) {
      return false;
    }
    service();
    return true;
  }

 private:
  SupervisorT& supervisor_;
  Board& board_;
  Watchdog& watchdog_;
  Service& service_;
  std::uint32_t period_ = 0;  ///< of the last sample
  bool begun_ = false;        ///< there was one; no counter says so, since all of them wrap
};

}  // namespace sonoglide::app
