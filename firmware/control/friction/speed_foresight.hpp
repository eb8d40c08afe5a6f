/// The sliding speed at which an answer will act.
#pragma once

#include "firmware/control/interface/signals.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Extrapolates the sliding velocity to the middle of the answer's effect, because shaper, latency
/// and carrier period delay the drive.
///
/// foreseen = |v + lead · s|, s the last change of v. The part of s beyond the change before is
/// extrapolated by at most |v|/8. If the two changes have opposite signs, nothing is extrapolated.
/// So a ramp is followed, and a step or a single wrong sample is hardly extrapolated. An
/// extrapolation through 0 gives 0. A velocity that has not changed by a code is the foreseen one.
///
/// Base: the peak vibration velocity at full drive.
template <class Scalar>
class SpeedForesight {
 public:
  /// @param lead  from a sample to the middle of its effect, in 64 carrier periods
  explicit SpeedForesight(Scalar lead) : lead_(lead) {}

  void restart() {
    begun_ = false;
    last_change_ = {};
  }

  /// One call for each sample.
  /// @return the foreseen speed, >= 0; fixed point saturates at full scale
  Scalar speed(Scalar velocity) {
    if (begun_ && velocity == last_velocity_) {
      last_change_ = {};
      return numeric::abs(numeric::observe<signal::ForeseenVelocity>(velocity));
    }
    const Scalar change = begun_ ? velocity - last_velocity_ : Scalar{};
    const bool opposite = numeric::opposite_signs(change, last_change_);
    const Scalar agreed = opposite ? Scalar{} : smaller(change, last_change_);
    last_velocity_ = velocity;
    last_change_ = change;
    begun_ = true;
    Scalar foreseen = velocity + ahead(agreed);
    if (change != agreed && !opposite) {
      const Scalar most = numeric::scale_by_power_of_two(numeric::abs(velocity), -3);
      foreseen += numeric::clamp_magnitude(ahead(change - agreed), most);
    }
    numeric::observe<signal::ForeseenVelocity>(foreseen);
    return numeric::same_sign(velocity, foreseen) ? numeric::abs(foreseen) : Scalar{};
  }

 private:
  Scalar ahead(Scalar change) const {
    return numeric::rounded<Scalar>(
        numeric::scale_by_power_of_two(numeric::accumulated_product(change, lead_), 6));
  }

  static Scalar smaller(Scalar a, Scalar b) { return numeric::abs(a) < numeric::abs(b) ? a : b; }

  Scalar lead_;
  Scalar last_velocity_{};
  Scalar last_change_{};
  bool begun_ = false;  ///< a sample since restart
};

}  // namespace sonoglide::control
