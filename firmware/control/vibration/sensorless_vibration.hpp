/// A vibration velocity that is held off resonance by the friction alone, its natural mode damped
/// by feedback.
#pragma once

#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/measurement.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/ratio.hpp"
#include "firmware/control/vibration/mode_damping.hpp"
#include "firmware/control/vibration/reading_lag.hpp"
#include "firmware/control/vibration/sensorless_observer.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// One step per carrier period. The steady amplitude u* = (v − o)/|H| brings the observed velocity to
/// the wanted one, v; on the way there the mode is damped (ModeDamping), as the friction shows it
/// (SensorlessObserver). As o takes up what the map and the model have wrong, the measured ratio settles
/// on its target without an integral.
///
/// @tparam MaxDelay  largest delay: carrier periods from the end of the period that a reading describes
///                   to the phase 0 at which its answer acts
/// @tparam ReadingT  PromptReading | LaggingReading
template <class ScalarT, int MaxDelay, class ReadingT>
class SensorlessVibration : public ModeDamping<ScalarT, MaxDelay, 2, SensorlessObserver<ScalarT>> {
  using Damping = ModeDamping<ScalarT, MaxDelay, 2, SensorlessObserver<ScalarT>>;
  using Damping::at_most_;
  using Damping::past_;

 protected:
  using Damping::observer_;

 public:
  static constexpr PartName part_name{"vibration/sensorless_vibration", "SensorlessVibration"};
  using Scalar = ScalarT;
  using Measurement = control::Measurement<Scalar>;
  using Command = DriveCommand<Scalar>;
  using Reading = ReadingT;

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
      : Damping(parameters.observer, parameters.delay),
        reading_(parameters.reading),
        backwards_(parameters.backwards) {}

  void restart(bool rested) {
    observer_.restart();
    reading_.restart();
    wanted_ = {};
    at_most_ = false;
    if (rested) {
      past_.clear();
    }
  }

  void before() { observer_.predict(past_.sampled() - past_.sampled(1)); }

  /// The target is another. A change by a quarter of the friction makes o as uncertain as at the
  /// start.
  /// @param change  in friction ratio, on base 2
  void retarget(Scalar change) {
    observer_.inflate_offset(numeric::limited_lift(numeric::abs(change), 3));
  }

  /// Takes the velocity that the ratio stands for without the lag of sensor and contact.
  template <class Feedforward>
  void sense(Scalar measured, Scalar speed, bool backwards, const Feedforward& feedforward) {
    const Scalar ratio =
        numeric::clamp(reading_.lag_compensated(measured), Scalar{}, whole_ratio<Scalar>);
    if (!(Scalar{} < speed)) {
      return;
    }
    const Scalar velocity = feedforward.amplitude(ratio, speed);
    if (backwards == backwards_) {
      observer_.observe(velocity, speed, {past_.sampled(), past_.sampled(1), past_.sampled(2)},
                        wanted_);
    }
  }

  /// The drive that brings the velocity to a wanted one in [0, 1].
  template <class Shaper>
  Request<Scalar> drive(Scalar velocity, const Shaper& /*shaper*/, Scalar ceiling) {
    wanted_ = velocity;
    const Scalar quarter = velocity == Scalar{} ? Scalar{} : observer_.quarter_amplitude(velocity);
    steady_ = this->steady(numeric::max(quarter, Scalar{}));
    const Scalar amplitude = this->damped(past_.newest() - steady_);
    const bool clipped = ceiling < amplitude;
    return {clipped ? ceiling : amplitude, clipped || at_most_ ? Limit::actuator : Limit::none};
  }

  /// That of what the steady drive makes of the velocity, by the model alone.
  template <class OfVelocity>
  Scalar implied_ratio(Scalar /*commanded*/, const OfVelocity& by_velocity) const {
    return by_velocity(observer_.nominal_velocity(steady_));
  }
  static constexpr Scalar reported_ratio(Scalar /*commanded*/) { return {}; }

 private:
  [[no_unique_address]] Reading reading_;
  bool backwards_;
  Scalar wanted_{};
  Scalar steady_{};  ///< u*
};

}  // namespace sonoglide::control
