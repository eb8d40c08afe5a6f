/// The sample of "How to add a friction law": a contact with a viscous film.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "firmware/friction/vibration.hpp"

namespace sonoglide::friction {

/// Viscous friction: phi = c V, Fc being the force at V = 1/c.
///
/// Passive for c >= 0: phi V = c V^2 >= 0. Not bounded by Fc.
/// Not modelled: the thickness of the film, which changes with the speed.
/// What the members mean is listed in friction/law.hpp.
template <class Number>
struct Viscous {
  using Scalar = Number;
  static constexpr Vibration vibration = Vibration::along;
  static constexpr bool reverses = false;
  static constexpr bool varies = true;
  static constexpr bool sticks = false;
  static constexpr bool rate_independent = false;
  static constexpr bool remembers = false;
  static constexpr bool has_corners = false;

  Scalar coefficient_of_velocity = Scalar(0);  ///< c [-], >= 0

  Scalar friction(Scalar velocity, Scalar /*last_friction*/) const {
    return coefficient_of_velocity * velocity;
  }
  Scalar rate(Scalar /*velocity*/, Scalar /*friction*/) const { return Scalar(0); }
  Scalar series_unit(Scalar /*velocity*/, Scalar /*friction*/, Scalar longest) const {
    return longest;
  }
  Scalar reach(Scalar /*velocity*/) const { return std::numeric_limits<Scalar>::infinity(); }

  template <std::size_t Order>
  class Series {
   public:
    Series(const Viscous& law, Scalar /*direction*/, Scalar /*friction*/) : law_(law) {}

    template <std::size_t N, class Travel>
    Scalar coefficient(const Travel& travel, Scalar unit) {
      return law_.coefficient_of_velocity * travel[N] / unit;
    }

   private:
    const Viscous& law_;
  };
};

}  // namespace sonoglide::friction
