/// A vibration velocity that is held off resonance by the friction alone, its natural mode damped
/// by feedback.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/measurement.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/signals.hpp"
#include "firmware/control/vibration/reading_lag.hpp"
#include "firmware/control/vibration/sensorless_observer.hpp"
#include "firmware/control/vibration/vibration_part.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// One step per carrier period. The steady amplitude u* = (v − o)/|H| brings the observed velocity
/// to the wanted one, v. The answer is
///   u' = u − K (w, u − u*), limited to [0, 1],
/// with the linear-quadratic gain K, u the latest command and w the mode foreseen at the phase 0
/// where it acts (SensorlessObserver). As o takes up what the map and the model have wrong, the
/// measured ratio settles on its target without an integral.
///
/// @tparam MaxDelay  largest delay: carrier periods from the end of the period that a reading describes
///                   to the phase 0 at which its answer acts
/// @tparam ReadingT  PromptReading | LaggingReading
template <class ScalarT, int MaxDelay, class ReadingT>
class SensorlessVibration : public VibrationPart<ScalarT> {
 public:
  static constexpr PartName part_name{"vibration/sensorless_vibration", "SensorlessVibration"};
  using Scalar = ScalarT;
  using Measurement = control::Measurement<Scalar>;
  using Command = DriveCommand<Scalar>;
  using Reading = ReadingT;
  using Requested = signal::RequestedVelocity;
  using Drive = typename VibrationPart<Scalar>::Drive;

  struct Parameters {
    typename SensorlessObserver<Scalar>::Parameters observer;
    [[no_unique_address]] typename Reading::Parameters reading;
    bool backwards;      ///< the direction of sliding that the table is of
    std::uint8_t delay;  ///< 0 … MaxDelay

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("observer", self.observer);
      visit("reading", self.reading);
      visit("backwards", self.backwards);
      visit("delay", self.delay);
    }
  };

  /// @param parameters  outlive this, see SensorlessObserver
  explicit SensorlessVibration(const Parameters& parameters)
      : observer_(parameters.observer),
        reading_(parameters.reading),
        backwards_(parameters.backwards),
        delay_(parameters.delay) {}

  /// See Controller::settle_at.
  void settle_at(const Parameters& parameters) { observer_.settle_at(parameters.observer); }

  void restart(bool rested) {
    observer_.restart();
    reading_.restart();
    wanted_ = {};
    at_most_ = false;
    if (rested) {
      amplitudes_ = {};
    }
  }

  void before() { observer_.predict(amplitudes_[sampled] - amplitudes_[sampled - 1]); }

  /// The target is another. A change by a quarter of the friction makes o as uncertain as at the
  /// start.
  /// @param change  in friction ratio, on base 2
  void retarget(Scalar change) {
    observer_.inflate_offset(numeric::limited_lift(numeric::abs(change), 3));
  }

  /// Takes the velocity that the ratio stands for without the lag of sensor and contact.
  template <class Feedforward>
  void sense(Scalar measured, Scalar speed, bool backwards, const Feedforward& feedforward) {
    constexpr Scalar whole = numeric::from_real<Scalar>(0.5);
    const Scalar ratio = numeric::clamp(reading_.lag_compensated(measured), Scalar{}, whole);
    if (!(Scalar{} < speed)) {
      return;
    }
    const Scalar velocity = feedforward.amplitude(ratio, speed);
    if (backwards == backwards_) {
      observer_.observe(velocity, speed,
                        {amplitudes_[sampled], amplitudes_[sampled - 1], amplitudes_[sampled - 2]},
                        wanted_);
    }
  }

  static constexpr Scalar highest(Scalar /*ceiling*/) {
    return numeric::from_code<Scalar>(INT32_MAX);  // of a velocity
  }

  /// The drive that brings the velocity to a wanted one in [0, 1].
  template <class Shaper>
  Drive drive(Scalar velocity, const Shaper& /*shaper*/, Scalar ceiling) {
    constexpr Scalar largest = numeric::from_code<Scalar>(INT32_MAX);
    wanted_ = velocity;
    const Scalar quarter = velocity == Scalar{} ? Scalar{} : observer_.quarter_amplitude(velocity);
    at_most_ = numeric::from_real<Scalar>(0.25) <= quarter;
    steady_ = largest;
    if (!at_most_) {
      steady_ = numeric::scale_by_power_of_two(numeric::max(quarter, Scalar{}), 2);
    }
    const Scalar latest = amplitudes_[last()];
    const Scalar less = numeric::clamp(observer_.feedback(predicted_mode(), latest - steady_),
                                       latest - largest, latest);
    const Scalar amplitude = latest - less;
    const bool clipped = ceiling < amplitude;
    return {clipped ? ceiling : amplitude, clipped || at_most_ ? Limit::actuator : Limit::none};
  }

  void after(const Command& command) {
    for (std::size_t i = 0; i < last(); ++i) {
      amplitudes_[i] = amplitudes_[i + 1];
    }
    amplitudes_[last()] = command.amplitude;
  }

  /// No more of a drive would help.
  bool at_most() const { return at_most_; }
  /// That of what the steady drive makes of the velocity, by the model alone.
  template <class OfVelocity>
  Scalar implied_ratio(Scalar /*commanded*/, const OfVelocity& by_velocity) const {
    return by_velocity(observer_.nominal_velocity(steady_));
  }
  static constexpr Scalar reported_ratio(Scalar /*commanded*/) { return {}; }

 private:
  static constexpr std::size_t sampled = 2;

  /// Of the newest command.
  std::size_t last() const {
    return (MaxDelay <= 1 ? std::size_t{MaxDelay} : std::size_t{delay_}) + sampled;
  }

  /// In the last period under way.
  Pair<Scalar> predicted_mode() const {
    Pair<Scalar> mode = observer_.mode();
    for (std::size_t i = sampled; i < last(); ++i) {
      mode = observer_.next(mode, amplitudes_[i + 1] - amplitudes_[i]);
    }
    return mode;
  }

  SensorlessObserver<Scalar> observer_;
  [[no_unique_address]] Reading reading_;
  bool backwards_;
  std::uint8_t delay_;
  std::array<Scalar, MaxDelay + sampled + 1> amplitudes_{};  ///< from two before the sampled one on
  Scalar wanted_{};
  Scalar steady_{};  ///< u*
  bool at_most_ = false;
};

}  // namespace sonoglide::control
