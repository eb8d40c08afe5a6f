/// A contact without friction.
#pragma once

#include <cstddef>

#include "firmware/friction/vibration.hpp"

namespace sonoglide::friction {

/// No friction: phi = 0. What the members mean is listed in law.hpp.
template <class Number>
struct None {
  using Scalar = Number;
  static constexpr Vibration vibration = Vibration::along;
  static constexpr bool reverses = false;
  static constexpr bool varies = false;
  static constexpr bool sticks = false;
  static constexpr bool rate_independent = true;
  static constexpr bool remembers = false;
  static constexpr bool has_corners = false;

  Scalar friction(Scalar /*velocity*/, Scalar /*last_friction*/) const { return Scalar(0); }
  Scalar rate(Scalar /*velocity*/, Scalar /*friction*/) const { return Scalar(0); }
  Scalar series_unit(Scalar /*velocity*/, Scalar /*friction*/, Scalar longest) const {
    return longest;
  }

  struct Arc {
    Arc(const None& /*law*/, Scalar /*direction*/, Scalar /*friction*/) {}

    template <std::size_t N, class Travel, class Coefficients>
    Scalar coefficient(const Travel& /*travel*/, const Coefficients& /*earlier*/) const {
      return Scalar(0);
    }
    Scalar friction_after(Scalar /*displacement*/) const { return Scalar(0); }
    Scalar work(Scalar /*displacement*/) const { return Scalar(0); }
  };
};

}  // namespace sonoglide::friction
