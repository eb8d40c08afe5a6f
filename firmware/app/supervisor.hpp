/// Faults of a running unit: kept, logged, and left by an explicit restart alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/app/exchange.hpp"
#include "firmware/app/fault_log.hpp"
#include "firmware/control/interface/drive_command.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

// A unit that nobody talks to.

/// Nobody can ask for a start, and no silence ends the drive.
struct NoHost {
  static constexpr bool drives_from_power_on = true;
  template <class T>
  using Word = PlainWord<T>;

  static constexpr bool falling() { return false; }
  static constexpr std::int32_t next() { return 0; }
  static void clear() {}
};

/// Faults that the loop finds, besides those of the controller (control::Fault, 16 … 31).
enum class UnitFault : std::uint8_t {
  overrun = 32,     ///< a step was not done when the next carrier period began
  watchdog_reset,   ///< the watchdog reset the board
  host_silent,      ///< nothing was heard for longer than host_timeout; the drive ramps down
  parameters_lost,  ///< what is stored is damaged; a restart is refused
  parameters_of_other_design,  ///< what is stored was set under another; a restart is refused
  service_stalled,             ///< the service did not come round, so that no stop would be heard
  image_damaged,  ///< the image in flash is not the one that was built; a restart is refused
  external = 64,  ///< and the cause: the board's hardware has switched the drive off
};

/// Causes of UnitFault::external are 1 ... 31, by the board's own count.
inline constexpr std::uint8_t last_external_cause = 31;

/// @param cause  above the last one it is taken for that
constexpr UnitFault external_fault(std::uint8_t cause) {
  const unsigned known = cause < last_external_cause ? cause : last_external_cause;
  return static_cast<UnitFault>(static_cast<unsigned>(UnitFault::external) + known);
}

/// A controller and its operation: off, running or in a fault. The drive is zero unless the
/// controller runs, or ramps down because its host fell silent.
///
/// @tparam Host  NoHost, or HostRamp where a service listens to somebody.
template <class ControllerT, class Host = NoHost, std::size_t LogLength = 16>
class Supervisor {
 public:
  using Controller = ControllerT;
  using Scalar = typename Controller::Scalar;
  using Sample = SampleOf<Controller>;
  using Drive = DriveOf<Controller>;
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
    typename Controller::Command rest{};
    if (running()) {
      rest = controller_.rest();  // the next step knows of the period at zero
    }
    controller_.start();
    drive_ = {};
    drive_.state = static_cast<std::uint8_t>(control::State::calibrating);
    hold_frequency(rest);
  }

  /// Drive to zero until a restart; a fault's cause is left to the log.
  void stop() { end(control::State::off, 0); }

  void trip(UnitFault fault) {
    end(control::State::fault, static_cast<std::uint8_t>(fault));
    log_.add({drive_.fault, periods_});
  }

  /// In place of step(), in a carrier period in which the board's hardware has tripped: the fault is kept with
  /// the first cause, from whatever the unit did.
  const Drive& hold(const Sample& sample, std::uint8_t cause) {
    begin(sample);
    if (drive_.fault < static_cast<std::uint8_t>(UnitFault::external)) {
      trip(external_fault(cause));
    }
    return drive_;
  }

  /// While running: a fault, but the drive ramps down instead of ending at once, at its frequency; a bias
  /// ends at once.
  void ramp_down(UnitFault fault) {
    if (running()) {
      const Drive last = drive_;
      trip(fault);
      drive_.amplitude = last.amplitude;
      hold_frequency(last);
      host_.begin(last.amplitude);
    }
  }

  /// One carrier period.
  const Drive& step(const Sample& sample) {
    begin(sample);
    return answer(sample);
  }

  /// The first part of step(): counts the period and keeps what it showed.
  void begin(const Sample& sample) {
    ++periods_;
    friction_force_ = sample.friction_force;
    sliding_velocity_ = sample.sliding_velocity;
  }

  /// The other: answers the sample.
  const Drive& answer(const Sample& sample) {
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

  // Nobody serves it, calibrates it or looks at it, and its target stands: see CommandedSupervisor.
  static constexpr void calibrate(const Sample& /*reading*/) {}
  static constexpr bool serviced() { return true; }
  static void publish() {}
  static void note_service() {}
  template <class Board>
  static constexpr void pass(const Sample& /*sample*/, Board& /*board*/) {}

  /// Neither off nor in a fault, or on the ramp down.
  bool driving() const { return running() || host_.falling(); }

  /// @param target  see Controller::set_target.
  void set_target(Scalar target) { controller_.set_target(target); }

  /// Another controller in its place, for the next restart; not while driving. settle_at() follows.
  void replace(const Controller& controller) { controller_ = controller; }

  /// See Controller::next_frequency; of a controller that leads it.
  std::int32_t next_frequency() const { return controller_.next_frequency(); }

  /// Codes of the last sample, and the answer to it.
  std::int32_t friction_force() const { return friction_force_; }
  std::int32_t sliding_velocity() const { return sliding_velocity_; }
  const Drive& drive() const { return drive_; }
  /// Served since reset; wraps, after 19.9 h at 60 kHz.
  std::uint32_t periods() const { return periods_; }
  const FaultLog<LogLength, Host::template Word>& faults() const { return log_; }

 private:
  /// @param command  whose frequency it is, if it has one
  template <class Command>
  void hold_frequency([[maybe_unused]] const Command& command) {
    if constexpr (std::is_same_v<Drive, hal::ResonantDrive>) {
      drive_.frequency = command.frequency;
    }
  }

  bool running() const { return control::runs(static_cast<control::State>(drive_.state)); }

  void end(control::State state, std::uint8_t fault) {
    host_.clear();
    controller_.stop();
    drive_ = {};
    drive_.state = static_cast<std::uint8_t>(state);
    drive_.fault = fault;
  }

  // The small ones first: small processors reach what is near the beginning by fewer instructions.
  std::int32_t friction_force_ = 0;
  std::int32_t sliding_velocity_ = 0;
  Drive drive_{};
  std::uint32_t periods_ = 0;
  [[no_unique_address]] Host host_;
  Controller controller_;
  FaultLog<LogLength, Host::template Word> log_;
};

}  // namespace sonoglide::app
