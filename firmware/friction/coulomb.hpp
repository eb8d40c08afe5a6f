/// Dry friction of constant magnitude.
#pragma once

#include <cstddef>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Coulomb friction: phi = sgn V while sliding; at V = 0 whatever holds the contact, |phi| <= 1.
///
///     phi   1 |-------
///             |
///     --------0--------  V
///             |
///     -------| -1
///
/// No parameter and no state. What the members mean is listed in friction/law.hpp.
/// A fixed-step method takes sgn 0 = 0 and chatters about a stick; an event solver resolves the
/// stick.
template <class Number>
struct Coulomb {
  using Scalar = Number;
  static constexpr Vibration vibration = Vibration::along;
  static constexpr bool reverses = true;
  static constexpr bool varies = false;
  static constexpr bool sticks = true;
  static constexpr bool rate_independent = true;
  static constexpr bool remembers = false;
  static constexpr bool has_corners = false;

  Scalar friction(Scalar velocity, Scalar /*last_friction*/) const {
    return numeric::sign(velocity);
  }
  Scalar rate(Scalar /*velocity*/, Scalar /*friction*/) const { return Scalar(0); }
  Scalar series_unit(Scalar /*velocity*/, Scalar /*friction*/, Scalar longest) const {
    return longest;
  }

  class Arc {
   public:
    Arc(const Coulomb& /*law*/, Scalar direction, Scalar /*friction*/) : direction_(direction) {}

    template <std::size_t N, class Travel, class Coefficients>
    Scalar coefficient(const Travel& /*travel*/, const Coefficients& /*earlier*/) const {
      return N == 0 ? direction_ : Scalar(0);
    }
    Scalar friction_after(Scalar /*displacement*/) const { return direction_; }
    Scalar work(Scalar displacement) const { return displacement; }

   private:
    Scalar direction_;
  };
};

}  // namespace sonoglide::friction
