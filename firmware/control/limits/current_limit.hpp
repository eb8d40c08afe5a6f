/// A drive whose current is kept below a limit.
#pragma once

#include <cstdint>

#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/near_root.hpp"
#include "firmware/numeric/polar.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// A drive whose current nobody limits.
template <class Scalar>
class FullCurrent {
 public:
  static constexpr PartName part_name{"limits/current_limit", "FullCurrent"};
  struct Parameters {};
  static constexpr bool limits = false;

  explicit FullCurrent(const Parameters&) {}
};

/// The current has the part of the motion, in phase with the velocity, and that of the clamped
/// capacitance, a quarter of a turn before the voltage, with the losses t = tan δ beside it. On
/// resonance velocity and voltage have one phase:
///   (a r + t b u)² + (b u)² <= 1,
/// a r and b u the two currents over the limit. Off resonance the sum is smaller, to first order.
template <class Scalar>
class CurrentLimit {
 public:
  static constexpr PartName part_name{"limits/current_limit", "CurrentLimit"};
  struct Parameters {
    numeric::Split<Scalar> motional;  ///< a
    numeric::Split<Scalar> inverse;   ///< 1/((1 + t²) b)
    Scalar loss_tangent;              ///< t/2
    Scalar small_motional;            ///< a s, at most 1/4
    Scalar small_capacitive;          ///< b s, likewise
    Scalar small_whole;               ///< s
    Scalar small_limit;               ///< s, less what regulation needs

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("motional", self.motional);
      visit("inverse", self.inverse);
      visit("loss_tangent", self.loss_tangent);
      visit("small_motional", self.small_motional);
      visit("small_capacitive", self.small_capacitive);
      visit("small_whole", self.small_whole);
      visit("small_limit", self.small_limit);
    }
  };
  static constexpr bool limits = true;

  explicit CurrentLimit(const Parameters& parameters)
      : parameters_(parameters),
        motional_(numeric::floating(parameters.motional)),
        twice_inverse_(numeric::rescaled(numeric::floating(parameters.inverse), 1)) {}

  /// Whether the limit lets a velocity be held, less what regulation needs.
  /// @param velocity  of the vibration
  /// @param holding   amplitude that holds it
  bool allows_holding(Scalar velocity, Scalar holding) const {
    const Scalar across = numeric::rough_product(parameters_.small_capacitive, holding);
    return within(along(velocity, across), across, parameters_.small_limit);
  }

  /// The part of a velocity that the limit lets be held, where it does not allow all of it.
  Scalar velocity(Scalar velocity, Scalar holding) const {
    const Scalar across = numeric::rough_product(parameters_.small_capacitive, holding);
    return numeric::multiplied(parameters_.small_limit * velocity,
                               numeric::polar(along(velocity, across), across).inverse);
  }

  /// Whether the limit lets an amplitude of the drive pass at a velocity. Quicker to tell than the
  /// largest one.
  bool allows(Scalar amplitude, Scalar velocity) const {
    const Scalar across =
        numeric::rough_product(parameters_.small_capacitive, numeric::abs(amplitude));
    const Scalar along = this->along(velocity, across);
    return within(along, across, parameters_.small_whole);
  }

  /// Largest amplitude of the drive at a velocity, (√(1 + t² − a² r²) − t a r)/((1 + t²) b); 0 where
  /// the motion alone takes more.
  Scalar highest(Scalar velocity) const {
    const Scalar motional = numeric::min(whole(), numeric::limited_product(velocity, motional_));
    const Scalar half_tangent = parameters_.loss_tangent;
    const Scalar quarter = numeric::from_real<Scalar>(0.25) + half_tangent * half_tangent -
                           numeric::half(motional) * numeric::half(motional);
    const Scalar root = numeric::near_root(numeric::max(quarter, Scalar{}));
    const Scalar half = numeric::max(root - half_tangent * motional, Scalar{});
    return numeric::min(whole(), numeric::limited_product(half, twice_inverse_));
  }

 private:
  static constexpr Scalar whole() { return numeric::from_code<Scalar>(INT32_MAX); }

  /// s (a r + t b u)
  /// @param across  s b u
  Scalar along(Scalar velocity, Scalar across) const {
    return numeric::rough_product(parameters_.small_motional, velocity) +
           numeric::twice(numeric::rough_product(parameters_.loss_tangent, across));
  }

  static bool within(Scalar along, Scalar across, Scalar limit) {
    return numeric::kept_square_sum(along, across) < numeric::kept_square_sum(limit, Scalar{});
  }

  Parameters parameters_;
  numeric::Floating<Scalar> motional_;
  numeric::Floating<Scalar> twice_inverse_;
};

}  // namespace sonoglide::control
