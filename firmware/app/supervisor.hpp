/// Faults of a running unit: kept, logged, and left by an explicit restart alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/app/exchange.hpp"
#include "firmware/control/interface/drive_command.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

// A unit that nobody talks to.

/// Nobody can ask for a start, and no silence ends the drive.
struct NoHost {
  static constexpr bool drives_from_power_on = true;

  static constexpr bool falling() { return false; }
  static constexpr std::int32_t next() { return 0; }
  static void clear() {}
};

// The last faults of a unit.

/// A fault, and when it was found.
struct FaultEntry {
  std::uint8_t fault;    ///< control::Fault or UnitFault
  std::uint32_t period;  ///< in which it was found: served since reset, this one included; wraps
};

/// Keeps the last `Length` faults since reset.
template <std::size_t Length>
class FaultLog {
 public:
  void add(const FaultEntry& entry) {
    entries_[next_] = entry;
    next_ = next_ + 1 < Length ? next_ + 1 : 0;
    count_ += count_ < UINT32_MAX ? 1U : 0U;
  }

  /// Faults since reset, those no longer kept included.
  std::uint32_t count() const { return count_; }
  std::size_t kept() const { return count_ < Length ? count_ : Length; }

  /// @param age  0 is the latest; less than kept().
  const FaultEntry& entry(std::size_t age) const {
    return entries_[next_ > age ? next_ - 1 - age : next_ + Length - 1 - age];
  }

 private:
  std::array<FaultEntry, Length> entries_{};
  std::size_t next_ = 0;
  std::uint32_t count_ = 0;
};

/// Faults that the loop finds, besides those of the controller (control::Fault, 16 … 31).
enum class UnitFault : std::uint8_t {
  overrun = 32,     ///< a step was not done when the next carrier period began
  watchdog_reset,   ///< the watchdog reset the board
  host_silent,      ///< nothing was heard for longer than host_timeout; the drive ramps down
  parameters_lost,  ///< what is stored is damaged; a restart is refused
  parameters_of_other_design,  ///< what is stored was set under another; a restart is refused
};

/// A controller and its operation: off, running or in a fault. The drive is zero unless the
/// controller runs, or ramps down because its host fell silent.
///
/// @tparam Host  NoHost, or HostRamp where a service listens to somebody.
template <class ControllerT, class Host = NoHost, std::size_t LogLength = 16>
class Supervisor {
 public:
  using Controller = ControllerT;
  using Scalar = typename Controller::Scalar;
  static constexpr bool drives_from_power_on = Host::drives_from_power_on;

  explicit Supervisor(const typename Controller::Parameters& parameters)
      : controller_(parameters) {}

  /// @param parameters  see Controller::settle_at
  template <class EqualParameters>
  void settle_at(const EqualParameters& parameters) {
    controller_.settle_at(parameters);
  }

  /// From any state: the drive begins afresh. The log is kept.
  void restart() {
    host_.clear();
    controller_.start();
    drive_ = {};
    drive_.state = static_cast<std::uint8_t>(control::State::calibrating);
  }

  /// Drive to zero until a restart; a fault's cause is left to the log.
  void stop() { end(control::State::off, 0); }

  void trip(UnitFault fault) {
    end(control::State::fault, static_cast<std::uint8_t>(fault));
    log_.add({drive_.fault, periods_});
  }

  /// While running: a fault, but the drive ramps down instead of ending at once.
  void ramp_down(UnitFault fault) {
    if (running()) {
      const std::int32_t amplitude = drive_.amplitude;
      trip(fault);
      drive_.amplitude = amplitude;
      host_.begin(amplitude);
    }
  }

  /// One carrier period.
  const hal::Drive& step(const hal::Sample& sample) {
    ++periods_;
    sample_ = sample;
    if (running()) {
      drive_ = drive_of(
          controller_.template step<control::Numbers::finite>(measurement_of<Scalar>(sample)));
      if (!running()) {
        log_.add({drive_.fault, periods_});
      }
    } else if (host_.falling()) {
      drive_.amplitude = host_.next();
    }
    return drive_;
  }

  /// Neither off nor in a fault, or on the ramp down.
  bool driving() const { return running() || host_.falling(); }

  /// @param half_ratio  see Controller::set_target.
  void set_target(Scalar half_ratio) { controller_.set_target(half_ratio); }

  /// Another controller in its place, for the next restart; not while driving. settle_at() follows.
  void reconfigure(const typename Controller::Parameters& parameters) {
    controller_ = Controller(parameters);
  }

  /// The last sample and the answer to it.
  const hal::Sample& sample() const { return sample_; }
  const hal::Drive& drive() const { return drive_; }
  /// Served since reset; wraps, after 19.9 h at 60 kHz.
  std::uint32_t periods() const { return periods_; }
  const FaultLog<LogLength>& faults() const { return log_; }

 private:
  bool running() const {
    return drive_.state != static_cast<std::uint8_t>(control::State::off) &&
           drive_.state != static_cast<std::uint8_t>(control::State::fault);
  }

  void end(control::State state, std::uint8_t fault) {
    host_.clear();
    controller_.stop();
    drive_ = {};
    drive_.state = static_cast<std::uint8_t>(state);
    drive_.fault = fault;
  }

  Controller controller_;
  hal::Sample sample_{};
  hal::Drive drive_{};
  std::uint32_t periods_ = 0;
  [[no_unique_address]] Host host_;
  FaultLog<LogLength> log_;
};

}  // namespace sonoglide::app
