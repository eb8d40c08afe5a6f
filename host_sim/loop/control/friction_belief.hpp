/// What a controller that learns its friction while driving believes, and how sure it is.
#pragma once

#include <cmath>

#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/friction/friction_tracking.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::loop {

/// With an interval that holds the true value with a probability of 95 %.
struct Believed {
  double value;
  double low_95;
  double high_95;

  Believed scaled(double factor) const {
    return {factor * value, factor * low_95, factor * high_95};
  }
};

/// Of a controller's own numbers: the force over the full scale of its sensor, the others over the
/// nominal ones.
struct FrictionBelief {
  Believed friction_force;
  Believed contact_stiffness;
  Believed gain;  ///< vibration velocity of a drive amplitude
};

namespace friction_belief_detail {

/// @param variance  of the logarithm
inline Believed believed(double value, double variance) {
  constexpr double deviations = 1.959963984540054;
  const double factor = std::exp(deviations * std::sqrt(variance));
  return {value, value / factor, value * factor};
}

template <class Scalar>
double real_of(const numeric::Floating<Scalar>& x) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return std::ldexp(numeric::to_real(x.mantissa), x.exponent);
  } else {
    return numeric::to_real(x);
  }
}

}  // namespace friction_belief_detail

/// @param agrees  the loop has settled where it is believed to; else nothing is sure
template <class Scalar>
FrictionBelief friction_belief(const control::FrictionLevel<Scalar>& level,
                               const control::FrictionTracking<Scalar>& tracking, bool agrees) {
  using namespace friction_belief_detail;
  constexpr Scalar most = control::FrictionTracking<Scalar>::Estimate::most_variance();
  const auto variance =
      agrees ? tracking.variance()
             : typename control::FrictionTracking<Scalar>::Estimate::Each{most, most, most};
  const double inverse_gain = real_of<Scalar>(tracking.inverse_gain());
  return {believed(numeric::to_real(level.force()), numeric::to_real(variance.force)),
          believed(real_of<Scalar>(tracking.contact()) * inverse_gain,
                   numeric::to_real(variance.stiffness)),
          believed(1.0 / inverse_gain, numeric::to_real(variance.gain))};
}

}  // namespace sonoglide::loop
