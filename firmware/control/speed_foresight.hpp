/// The sliding speed at which an answer will act.
#pragma once

#include "firmware/control/signals.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Extrapolates the sliding velocity to the middle of the answer's effect: shaper, latency and
/// carrier period delay the drive, and a sliding velocity that changes would find it late.
///
/// foreseen = |v + lead · s|, s the smaller of the last two changes of v where they have one sign,
/// and 0 where they have not (the minmod slope): a ramp is followed, a single wrong sample or a
/// step is not carried on. A velocity never changes its sign by extrapolation: 0 then.
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
    const Scalar slope = known_ > 1 ? smaller(change, last_change_) : Scalar{};
    last_velocity_ = velocity;
    last_change_ = change;
    known_ += known_ < 2 ? 1 : 0;
    const Scalar foreseen = numeric::observe<signal::ForeseenVelocity>(
        velocity + numeric::rounded<Scalar>(numeric::scale_by_power_of_two(
                       numeric::accumulated_product(slope, lead_), 6)));
    const bool turned = (velocity < Scalar{}) != (foreseen < Scalar{});
    return turned ? Scalar{} : numeric::abs(foreseen);
  }

 private:
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
