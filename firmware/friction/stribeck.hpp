/// Dry friction that falls with the speed and rises again: a cubic Stribeck curve.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Cubic Stribeck friction: phi = sgn V - a V + b V^3 while sliding; at V = 0 whatever holds the
/// contact, |phi| <= 1.
///
///     phi  1 |\                 /
///            | \              /
///            |   `--.______.-'     least at |V| = sqrt(a / 3 b)
///     -------0-----------------  V
///
/// In SI units mu(v) = mu_s sgn v - alpha v + beta v^3, Fc = mu_s N. The force is least at
/// |V| = sqrt(a / 3 b), and beyond sqrt(a / b) it passes that of the contact at rest.
/// Passive where 4 a^3 <= 27 b: then phi V >= 0 at any speed. Falling friction still feeds a
/// vibration: a body on a spring that is pulled slowly sticks and slips.
/// Limit: a = b = 0 is Coulomb.
/// Not modelled: presliding displacement, friction lag, a contact at rest that grows stronger.
/// What the members mean is listed in friction/law.hpp.
/// Source: Thomsen 1999 (README.md).
template <class Number>
struct Stribeck {
  using Scalar = Number;
  static constexpr Vibration vibration = Vibration::along;
  static constexpr bool reverses = true;
  static constexpr bool varies = true;
  static constexpr bool sticks = true;
  static constexpr bool rate_independent = false;
  static constexpr bool remembers = false;
  static constexpr bool has_corners = false;

  Scalar fall = Scalar(0);  ///< a = alpha omega L / mu_s [-], >= 0
  Scalar rise = Scalar(0);  ///< b = beta (omega L)^3 / mu_s [-], >= 0

  Scalar friction(Scalar velocity, Scalar /*last_friction*/) const {
    return numeric::sign(velocity) - velocity * (fall - rise * velocity * velocity);
  }
  Scalar rate(Scalar /*velocity*/, Scalar /*friction*/) const { return Scalar(0); }
  Scalar series_unit(Scalar /*velocity*/, Scalar /*friction*/, Scalar longest) const {
    return longest;
  }
  Scalar reach(Scalar /*velocity*/) const { return std::numeric_limits<Scalar>::infinity(); }

  template <std::size_t Order>
  class Series {
   public:
    Series(const Stribeck& law, Scalar direction, Scalar /*friction*/)
        : law_(law), direction_(direction) {}

    template <std::size_t N, class Travel>
    Scalar coefficient(const Travel& travel, Scalar unit) {
      velocity_[N] = travel[N] / unit;
      square_[N] = product(velocity_, N);
      const Scalar cube = product(square_, N);
      const Scalar curve = law_.rise * cube - law_.fall * velocity_[N];
      return N == 0 ? direction_ + curve : curve;
    }

   private:
    using Coefficients = std::array<Scalar, Order + 1>;

    /// The n-th coefficient of a V.
    Scalar product(const Coefficients& a, std::size_t n) const {
      Scalar sum = Scalar(0);
      for (std::size_t j = 0; j <= n; ++j) {
        sum += a[j] * velocity_[n - j];
      }
      return sum;
    }

    const Stribeck& law_;
    Scalar direction_;
    Coefficients velocity_{};  ///< V
    Coefficients square_{};    ///< V^2
  };
};

}  // namespace sonoglide::friction
