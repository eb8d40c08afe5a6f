/// Real numbers of a design in a controller's own scalar.
#pragma once

#include <type_traits>

#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"
#include "host_sim/configure/control_design.hpp"

namespace sonoglide::configure {

/// Names a type without an object of it.
template <class T>
struct Type {
  using type = T;
};

template <class Scalar>
Scalar scaled(double value) {
  return numeric::from_real<Scalar>(value);
}

/// A number that fixed point limits to its range.
template <class Scalar>
Scalar scaled_within(double value) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return value < 1.0 ? scaled<Scalar>(value) : Scalar::largest();
  }
  return scaled<Scalar>(value);
}

/// A number of any magnitude, not negative.
template <class Scalar>
numeric::Split<Scalar> split(double value) {
  const numeric::Split<double> parts = numeric::split(value);
  return {scaled<Scalar>(parts.mantissa), parts.exponent};
}

/// A target as a controller takes it: a friction ratio, or a force [N].
template <class Scalar>
Scalar target_of(const ControlDesign& design, double target) {
  return scaled<Scalar>(design.holds_force ? target / design.scales.force_N : 0.5 * target);
}

/// Of a part that has none.
template <class Part>
std::enable_if_t<std::is_empty_v<typename Part::Parameters>, typename Part::Parameters> parameters(
    const ControlDesign& /*design*/, Type<Part> /*part*/) {
  return {};
}

}  // namespace sonoglide::configure
