/// How the errors of single steps add up.
#pragma once

#include "firmware/numeric/float_sqrt.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// What friction makes of an error of the velocity that stays.
enum class Drift {
  hardly_felt,     ///< friction opposes it, in steps that are short for other reasons
  of_velocity,     ///< friction follows the velocity
  of_displacement  ///< friction follows the displacement, in which the error piles up
};

/// The part of a tolerance that the error of a step may take, in (0, 1], for a hundred carrier
/// periods to keep the tolerance.
///
/// 1 while the natural mode turns, because the errors of the steps then cancel. They add up in a
/// mode slower than 1/8 of the drive, the more the slower it is, so that a free mass drifts; and in
/// a mode faster than the drive, whose phase each step moves the same way. The numbers were found
/// by trial.
/// stiffness: k = Ks / (m omega^2), the square of the natural mode over the drive.
template <class Scalar>
Scalar step_share(Scalar stiffness, Drift drift) {
  constexpr Scalar fast = numeric::from_real<Scalar>(1.25);
  constexpr Scalar slow_modes_per_drive = Scalar(8);
  constexpr Scalar least = numeric::from_real<Scalar>(1.0 / 400.0);
  constexpr Scalar least_of_velocity = numeric::from_real<Scalar>(1.0 / 64.0);
  if (drift == Drift::hardly_felt) {
    return Scalar(1);
  }
  if (stiffness > fast) {
    return numeric::max(least, Scalar(1) / (Scalar(8) * stiffness));
  }
  const Scalar mode = numeric::sqrt(numeric::max(Scalar(0), stiffness));
  const Scalar share = numeric::min(Scalar(1), slow_modes_per_drive * mode);
  return drift == Drift::of_velocity ? numeric::max(least_of_velocity, share)
                                     : numeric::max(least, share * share);
}

}  // namespace sonoglide::plant
