/// A vibration velocity that is held off resonance, its natural mode damped by feedback.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/measurement.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/vibration/mode_damping.hpp"
#include "firmware/control/vibration/mode_observer.hpp"
#include "firmware/control/vibration/pair.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/near_root.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// One step per carrier period, at a fixed frequency. The steady amplitude u* is what brings the
/// vibration |H u* + o| to the wanted velocity v; on the way there the mode is damped (ModeDamping), as
/// the vibration shows it (ModeObserver).
///
/// @tparam MaxDelay  largest delay: carrier periods from the end of a sampled period to the phase 0
///                   at which its answer acts
template <class ScalarT, int MaxDelay>
class DampedVibration : public ModeDamping<ScalarT, MaxDelay, 1, ModeObserver<ScalarT>> {
  using Damping = ModeDamping<ScalarT, MaxDelay, 1, ModeObserver<ScalarT>>;
  using Damping::observer_;
  using Damping::past_;

 public:
  static constexpr PartName part_name{"vibration/damped_vibration", "DampedVibration"};
  using Scalar = ScalarT;
  using Measurement = VibrationMeasurement<Scalar>;
  using Command = ResonantCommand<Scalar>;
  static constexpr bool observed = true;
  /// Samples in a row in which a drive of a quarter or more shows no vibration, until
  /// Fault::vibration_missing.
  static constexpr int missing_samples = 16;
  /// Samples in a row that are mostly offset under such a drive, until Fault::resonance_lost.
  static constexpr int lost_samples = 64;

  struct Parameters {
    typename ModeObserver<Scalar>::Parameters observer;
    Scalar settled;      ///< what noise adds to the error of a settled velocity
    Scalar missing;      ///< velocity that a drive of a quarter shows at least
    std::uint8_t delay;  ///< 0 … MaxDelay

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("observer", self.observer);
      visit("settled", self.settled);
      visit("missing", self.missing);
      visit("delay", self.delay);
    }
  };

  /// @param parameters  outlive this, see ModeObserver
  explicit DampedVibration(const Parameters& parameters)
      : Damping(parameters.observer, parameters.delay),
        noise_(parameters.settled),
        missing_below_(parameters.missing) {}

  void restart(bool rested) {
    observer_.restart();
    quarter_offset_ = {};
    missing_ = 0;
    lost_ = 0;
    settled_ = false;
    this->at_most_ = false;
    if (rested) {
      past_.clear();
    }
  }

  /// Takes a sample of usable numbers.
  Fault observe(const Measurement& measurement) {
    const Pair<Scalar> sample{measurement.in_phase, measurement.quadrature};
    const Scalar amplitude = past_.sampled();
    observer_.observe(sample, past_.sampled(1), amplitude);
    const bool hard = numeric::from_real<Scalar>(0.25) <= amplitude;
    missing_ = hard && magnitude(sample) < missing_below_ ? missing_ + 1 : 0;
    quarter_offset_ = observer_.quarter_offset();
    const Scalar most = numeric::rough_product(numeric::from_real<Scalar>(0.1875),
                                               amplitude);  // 3/4 of a quarter
    lost_ = hard && most < magnitude(quarter_offset_) ? lost_ + 1 : 0;
    if (missing_ >= missing_samples) {
      return Fault::vibration_missing;
    }
    return lost_ >= lost_samples ? Fault::resonance_lost : Fault::none;
  }

  /// The drive that brings the velocity to a wanted one in [0, 1].
  template <class Shaper>
  Request<Scalar> drive(Scalar velocity, const Shaper& /*shaper*/, Scalar /*ceiling*/) {
    const Scalar steady = this->steady(steady_quarter(velocity));
    const Scalar error = past_.newest() - steady;
    settled_ = settled(velocity, steady, error);
    if (velocity == Scalar{} && settled_) {
      return {Scalar{}, Limit::none};  // at rest, as far as the sensor tells
    }
    return {this->damped(error), this->at_most() ? Limit::actuator : Limit::none};
  }

  /// The velocity is the one that was last asked for, or the nearest one that the drive reaches.
  bool settled() const { return settled_; }

 private:
  static Scalar magnitude(const Pair<Scalar>& pair) {
    return numeric::max(numeric::abs(pair.first), numeric::abs(pair.second));
  }

  /// Mode and amplitude are within 1/32, but for what noise adds, and for 1/256 of full drive.
  bool settled(Scalar velocity, Scalar steady, Scalar error) const {
    constexpr int band = -5;
    const Scalar mode = numeric::scale_by_power_of_two(velocity, band) + noise_;
    const Scalar amplitude =
        numeric::scale_by_power_of_two(steady, band) + numeric::from_real<Scalar>(0x1p-8);
    return magnitude(observer_.visible()) <= mode && numeric::abs(error) <= amplitude;
  }

  /// u*/4: √((v/|H|)² − o⊥²) − o∥, o as an amplitude along H and across it.
  Scalar steady_quarter(Scalar velocity) const {
    if (velocity == Scalar{}) {
      return {};
    }
    const Scalar across = quarter_offset_.second;
    const Scalar amplitude = observer_.quarter_amplitude(velocity);
    const Scalar square = numeric::difference_of_products(amplitude, amplitude, across, across);
    const Scalar along = square < Scalar{} ? Scalar{} : numeric::near_root(square);
    const Scalar half = numeric::half_difference(along, quarter_offset_.first);
    return numeric::twice(numeric::clamp(half, Scalar{}, numeric::from_real<Scalar>(0.25)));
  }

  Scalar noise_;
  Scalar missing_below_;
  Pair<Scalar> quarter_offset_{};  ///< of the observer
  int missing_ = 0;
  int lost_ = 0;
  bool settled_ = false;
};

}  // namespace sonoglide::control
