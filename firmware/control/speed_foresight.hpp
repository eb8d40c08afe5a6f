/// The sliding speed at which an answer will act.
#pragma once

#include "firmware/control/signals.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Extrapolates the sliding velocity to the middle of the answer's effect: shaper, latency and
/// carrier period delay the drive, and a sliding velocity that changes would find it late.
///
/// foreseen = |v + lead · s|, s the last change of v. As far as the change before does not agree,
/// the extrapolation is no more than |v|/8: a ramp is followed, a single wrong sample or a step is
/// hardly carried on. A velocity never changes its sign by extrapolation: 0 then.
///
/// Base: the peak vibration velocity at full drive.
template <class Scalar>
class SpeedForesight {
 public:
  /// @param lead  from a sample to the middle of its effect, in 64 carrier periods
  explicit SpeedForesight(Scalar lead) : lead_(lead) {}

  void restart() { known_ = 0; }

  /// One call for each sample.
  /// @return the foreseen speed, >= 0; fixed point saturates at full scale
  Scalar speed(Scalar velocity) {
    const Scalar change = known_ > 0 ? velocity - last_velocity_ : Scalar{};
    const Scalar agreed = known_ > 1 ? smaller(change, last_change_) : Scalar{};
    last_velocity_ = velocity;
    last_change_ = change;
    known_ += known_ < 2 ? 1 : 0;
    Scalar foreseen = velocity + ahead(agreed);
    if (change != agreed) {
      const Scalar most = numeric::scale_by_power_of_two(numeric::abs(velocity), -3);
      foreseen += numeric::clamp(ahead(change - agreed), -most, most);
    }
    numeric::observe<signal::ForeseenVelocity>(foreseen);
    const bool turned = (velocity < Scalar{}) != (foreseen < Scalar{});
    return turned ? Scalar{} : numeric::abs(foreseen);
  }

 private:
  Scalar ahead(Scalar change) const {
    return numeric::rounded<Scalar>(
        numeric::scale_by_power_of_two(numeric::accumulated_product(change, lead_), 6));
  }

  /// Of two that have one sign the smaller, else 0.
  static Scalar smaller(Scalar a, Scalar b) {
    if ((a < Scalar{}) != (b < Scalar{})) {
      return Scalar{};
    }
    return numeric::abs(a) < numeric::abs(b) ? a : b;
  }

  Scalar lead_;
  Scalar last_velocity_{};
  Scalar last_change_{};
  int known_ = 0;  ///< samples since restart, up to 2
};

}  // namespace sonoglide::control
