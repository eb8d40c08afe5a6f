/// Where in the table of natural frequencies a mode is.
#pragma once

#include <cstdint>

#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Recursive least squares with forgetting (Ljung 1999, ../README.md): p + ψ·e/S, e what a forecast
/// has missed, ψ its slope over p, S the sum of ψ² with forgetting.
///
/// p: from -1 to 1. In fixed point S is on base 64, and what ψ·e/S has beyond ±1 is cut off.
template <class Scalar>
class FrequencyEstimate {
 public:
  /// Exponent of the base of S.
  static constexpr int base = numeric::is_fixed_point_v<Scalar> ? 6 : 0;

  /// At the nominal frequency.
  void restart() {
    weight_ = {};
    frequency_parameter_ = {};
  }

  /// S is at least this, on its base, so that a single sample does not move p far.
  void weigh(Scalar least) { weight_ = numeric::max(weight_, least); }

  /// @param square, gradient  ψ·ψ on the base of S, and ψ·e
  /// @return by how much the frequency parameter has moved
  Scalar move(Scalar square, Scalar gradient) {
    constexpr Scalar keep = numeric::from_real<Scalar>(0.97);
    constexpr Scalar end = numeric::from_code<Scalar>(INT32_MAX - 1);
    weight_ = keep * weight_ + square;
    if (!(Scalar{} < weight_)) {
      return {};
    }
    const auto one_half = numeric::floating(numeric::from_real<Scalar>(0.5));
    const auto inverse =
        numeric::rescaled(numeric::quotient(one_half, numeric::floating(weight_)), 1 - base);
    constexpr Scalar farthest = numeric::from_real<Scalar>(0.999);
    const Scalar move =
        numeric::clamp_magnitude(numeric::limited_product(gradient, inverse), farthest);
    const Scalar half = numeric::half(frequency_parameter_) + numeric::half(move);
    const Scalar before = frequency_parameter_;
    frequency_parameter_ = numeric::twice(numeric::clamp_magnitude(half, numeric::half(end)));
    return frequency_parameter_ - before;
  }

  Scalar frequency_parameter() const { return frequency_parameter_; }

 private:
  Scalar weight_{};
  Scalar frequency_parameter_{};
};

}  // namespace sonoglide::control
