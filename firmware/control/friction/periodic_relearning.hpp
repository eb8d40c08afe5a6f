/// Short pauses of the drive in which the undriven friction force is learnt anew.
#pragma once

#include <cstdint>

#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// What the controller is to do in a period.
enum class Task : std::uint8_t {
  regulate,  ///< no pause
  pause,     ///< request zero
  resume,    ///< a pause, but the request is as it would be without
  learn,     ///< the request stands, and force() is new
  adapt,     ///< the request stands, for what else follows from force()
};

/// What is learnt from: a sample, and the command that stood before it.
template <class Scalar>
struct FrictionReading {
  Scalar force;      ///< measured, along the sliding
  Scalar measured;   ///< friction ratio on base 2
  Scalar speed;      ///< of the sliding, base: peak vibration velocity at full drive
  Scalar commanded;  ///< friction ratio on base 2
  Scalar requested;  ///< amplitude, or vibration velocity
  bool followed;     ///< the drive could follow the command
};

/// What changes with a friction force that was learnt.
template <class Scalar>
struct FrictionChange {
  Scalar target;     ///< friction ratio on base 2
  Scalar commanded;  ///< likewise
  Scalar before;     ///< Fc
  Scalar
      reading;  ///< the friction ratio on base 2 of the force that was the target, over the Fc learnt
  bool settling;  ///< false: the loop does not settle
};

/// What parts share that learn the friction while the controller runs.
template <class Scalar>
class RelearningPart {
 public:
  /// Of the drive in a pause.
  static constexpr Scalar request(Scalar /*speed*/) { return {}; }

  /// Sets a feedforward to what is known of the friction.
  template <class Feedforward>
  static void adapt(Feedforward& feedforward, const FrictionLevel<Scalar>& level) {
    feedforward.set_friction(level);
  }

  /// Tells the feedback what the adapted map has at the request that stands.
  template <class Regulator, class Feedforward>
  static constexpr void align(Regulator& /*regulator*/, const Feedforward& /*map*/,
                              Scalar /*speed*/, Scalar /*requested*/) {}
};

/// The friction force is not learnt again while the drive is on.
template <class Scalar>
class NoRelearning : public RelearningPart<Scalar> {
 public:
  static constexpr PartName part_name{"friction/periodic_relearning", "NoRelearning"};
  struct Parameters {};

  explicit NoRelearning(const Parameters&) {}

  static constexpr void restart() {}
  template <class Feedforward>
  static constexpr void interrupt(const Feedforward&, const FrictionLevel<Scalar>&) {}
  static constexpr bool pausing() { return false; }
  template <class Feedforward>
  static constexpr Task next(const FrictionReading<Scalar>&, const Feedforward&) {
    return Task::regulate;
  }
  static constexpr Scalar force(Scalar before) { return before; }
  template <class Regulator>
  static constexpr void correct(Regulator&, const FrictionChange<Scalar>&) {}
};

/// At regular intervals the request is zero, through the shaper, for as many periods as the contact
/// needs to slide through its presliding distance. It comes back before the last undriven reading
/// has arrived. A pause in which the sliding reverses or becomes too slow teaches nothing.
///
/// Periods of a pause, shaper over its span, latency and sensor R, presliding slid through in n,
/// readings averaged a:
///   request zero     2M + n + a
///   drive disturbed  4M + n + a, longer where the friction force has changed
///   learnt           R periods after the last request of zero; the request then stands for two
template <class Scalar>
class PeriodicRelearning : public RelearningPart<Scalar> {
 public:
  static constexpr PartName part_name{"friction/periodic_relearning", "PeriodicRelearning"};
  struct Parameters {
    std::uint32_t every_periods;  ///< from the beginning of a pause to that of the next
    std::uint16_t quiet_periods;  ///< until shaper and sensor show no drive
    Scalar travel;                ///< presliding travel, in 64 carrier periods at full drive's peak
                                  ///< vibration velocity
    std::uint16_t reading_periods;        ///< R: from a request to the reading that shows it
    std::uint16_t return_periods;         ///< after that, until shaper and contact are back, >= 1
    std::uint8_t average_periods;         ///< a, >= 1
    numeric::Accumulator<Scalar> weight;  ///< 1/a

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("every_periods", self.every_periods);
      visit("quiet_periods", self.quiet_periods);
      visit("travel", self.travel);
      visit("reading_periods", self.reading_periods);
      visit("return_periods", self.return_periods);
      visit("average_periods", self.average_periods);
      visit("weight", self.weight);
    }
  };
  /// As every_periods: no pause at all.
  static constexpr std::uint32_t never = UINT32_MAX;

  explicit PeriodicRelearning(const Parameters& parameters) : parameters_(parameters) {}

  void restart() {
    since_begin_ = 0;
    phase_ = Phase::idle;
  }

  /// Ends a pause, with `adapt` if that would have been next.
  template <class Feedforward>
  void interrupt(Feedforward& feedforward, const FrictionLevel<Scalar>& level) {
    if (phase_ == Phase::slid && count_ == learnt_after()) {
      this->adapt(feedforward, level);
    }
    phase_ = Phase::idle;
  }

  bool pausing() const { return phase_ != Phase::idle; }

  /// One call for each period in which the drive is to hold a ratio.
  template <class Feedforward>
  Task next(const FrictionReading<Scalar>& reading, const Feedforward& /*feedforward*/) {
    since_begin_ += since_begin_ + 1 < never ? 1U : 0U;
    if (phase_ == Phase::idle && since_begin_ >= parameters_.every_periods) {
      begin();
    }
    switch (phase_) {
      case Phase::idle:
        return Task::regulate;
      case Phase::quiet:
        wait();
        return Task::pause;
      case Phase::sliding:
        slide(reading.speed);
        return Task::pause;
      case Phase::slid:
        break;
    }
    return conclude(reading.force);
  }

  /// Mean of what was learnt in the last pause.
  Scalar force(Scalar /*before*/) const { return numeric::rounded<Scalar>(mean_); }

  /// After a small change the integral gives up what it had corrected for it. After a large change,
  /// and if the loop does not settle, the integral begins anew.
  template <class Regulator>
  void correct(Regulator& regulator, const FrictionChange<Scalar>& change) const {
    const bool small = numeric::abs(force(change.before) - change.before) <
                       numeric::scale_by_power_of_two(change.before, -4);
    if (small && change.settling) {
      regulator.shift(change.target, change.reading);
    } else {
      regulator.restart(change.target);
    }
  }

 private:
  enum class Phase : std::uint8_t { idle, quiet, sliding, slid };

  void begin() {
    since_begin_ = 0;
    count_ = 0;
    travelled_ = {};
    mean_ = {};
    phase_ = parameters_.quiet_periods > 0 ? Phase::quiet : Phase::sliding;
  }

  void wait() {
    if (++count_ >= parameters_.quiet_periods) {
      count_ = 0;
      phase_ = Phase::sliding;
    }
  }

  void slide(Scalar speed) {
    travelled_ += numeric::scale_by_power_of_two(numeric::accumulate(speed), -6);
    if (!(travelled_ < numeric::accumulate(parameters_.travel))) {
      count_ = 0;
      phase_ = Phase::slid;
    }
  }

  /// Called from the first request on whose period is slid through from its beginning.
  Task conclude(Scalar force) {
    const std::uint32_t now = count_++;
    const std::uint32_t shown = parameters_.reading_periods;
    if (shown <= now && now < learnt_after()) {
      mean_ += numeric::accumulate(force) * parameters_.weight;
    }
    if (now + 1 >= learnt_after() + parameters_.return_periods) {
      phase_ = Phase::idle;
    }
    if (now + 1 == learnt_after()) {
      return Task::learn;
    }
    if (now == learnt_after()) {
      return Task::adapt;
    }
    return now < parameters_.average_periods ? Task::pause : Task::resume;
  }

  /// Number of readings, from the begin of the period slid through, until the force is learnt.
  std::uint32_t learnt_after() const {
    return std::uint32_t{parameters_.reading_periods} + parameters_.average_periods;
  }

  Parameters parameters_;
  std::uint32_t since_begin_ = 0;
  std::uint16_t count_ = 0;
  Phase phase_ = Phase::idle;
  numeric::Accumulator<Scalar> travelled_{};
  numeric::Accumulator<Scalar> mean_{};
};

}  // namespace sonoglide::control
