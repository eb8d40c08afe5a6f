/// Presliding friction after Dahl, with its exact solution between two reversals.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/lane_group.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Dahl friction: d phi / d tau = kappa (V - |V| phi).
///
///     phi   1 ........______     loaded: 1 - exp(-kappa u)
///               __---
///            _-    /             unloaded: -1 + 2 exp(-kappa |u|), as steep as twice kappa
///          -    _-
///     -1 ______- ..........  u
///
/// Between two reversals, with s = sgn V and e = 1 - s phi, the force depends on the displacement
/// alone: e(u) = e(0) exp(-kappa |u|). So |phi| <= 1 always. Passive: the work done on the contact
/// is never less than -phi^2 / (2 kappa). What the members mean is listed in friction/law.hpp.
/// Source: Dahl 1968 (README.md).
template <class Number>
struct Dahl {
  using Scalar = Number;
  static constexpr Vibration vibration = Vibration::along;
  static constexpr bool reverses = true;
  static constexpr bool varies = true;
  static constexpr bool sticks = false;
  static constexpr bool rate_independent = true;
  static constexpr bool remembers = false;
  static constexpr bool has_corners = false;

  Scalar contact_stiffness = Scalar(1);  ///< kappa = Kt L / Fc [-], > 0

  Scalar friction(Scalar /*velocity*/, Scalar last_friction) const { return last_friction; }
  Scalar rate(Scalar velocity, Scalar friction) const {
    return contact_stiffness * (velocity - numeric::abs(velocity) * friction);
  }
  Scalar series_unit(Scalar velocity, Scalar friction, Scalar longest) const {
    const Scalar moderate = Scalar(16);
    const Scalar rate = contact_stiffness * numeric::abs(velocity);
    const bool slips = numeric::abs(friction) == Scalar(1) && velocity * friction > Scalar(0);
    if (longest * (rate + contact_stiffness * longest) <= moderate || slips) {
      return longest;
    }
    return numeric::min(longest, moderate / (Scalar(1) + rate));
  }

  /// Coefficients of phi for n >= 1 are those of g = phi - s, which decays: g' = -kappa s V g.
  class Arc {
   public:
    /// direction 0 holds the friction where it is.
    Arc(const Dahl& law, Scalar direction, Scalar friction)
        : contact_stiffness_(law.contact_stiffness),
          direction_(direction),
          friction_(friction),
          decay_(-law.contact_stiffness * direction),
          gap_(friction - direction) {}

    template <std::size_t N, class Travel, class Coefficients>
    Scalar coefficient(const Travel& travel, const Coefficients& earlier) const {
      if constexpr (N == 0) {
        return friction_;
      } else {
        const Scalar factor = decay_ * numeric::from_real<Scalar>(1.0 / static_cast<double>(N));
        if constexpr (N == 1) {
          return factor * gap_ * travel[0];
        } else {
          // From the middle outwards, and the newest factors by one product each: what is known
          // early does not wait for them.
          constexpr std::size_t middle = N / 2;
          Scalar sum = N % 2 == 0 ? Scalar(0) : travel[middle] * earlier[middle];
          for (std::size_t j = middle; j-- > 1;) {
            const std::size_t mirrored = N - 1 - j;
            sum += travel[j] * earlier[mirrored] + travel[mirrored] * earlier[j];
          }
          return (factor * sum + (factor * gap_) * travel[N - 1]) +
                 (factor * travel[0]) * earlier[N - 1];
        }
      }
    }
    [[gnu::always_inline]] Scalar friction_after(Scalar displacement) const {
      return numeric::clamp(friction_ + gap_ * minus_decayed(contact_stiffness_ * displacement),
                            Scalar(-1), Scalar(1));
    }
    template <class Numbers>
    [[gnu::always_inline]] Numbers friction_along(Numbers displacement) const {
      const Numbers exponent = numeric::at_most<Scalar>(numeric::longest_decay<Scalar>,
                                                        contact_stiffness_ * displacement);
      return direction_ + gap_ * numeric::moderate_decay<Scalar>(exponent);
    }
    Scalar work(Scalar displacement) const {
      const Scalar z = contact_stiffness_ * displacement;
      return direction_ * (displacement * (friction_ - gap_ * (z * decay_remainder(z))));
    }

   private:
    /// Below this argument a series replaces exp, whose argument reduction takes longer. Most steps
    /// are that short.
    static constexpr Scalar series_end = Scalar(1);

    /// exp(-z) - 1, z >= 0.
    [[gnu::always_inline]] static Scalar minus_decayed(Scalar z) {
      return z < series_end ? z * (z * decay_remainder_series(z) - Scalar(1)) : numeric::expm1(-z);
    }

    /// (exp(-z) - 1 + z) / z^2, z >= 0, to full relative accuracy.
    static Scalar decay_remainder(Scalar z) {
      return z < series_end ? decay_remainder_series(z) : (numeric::expm1(-z) + z) / (z * z);
    }

    /// (exp(-z) - 1 + z) / z^2 for 0 <= z <= 1, by its series. Each level doubles the powers of z.
    [[gnu::always_inline]] static Scalar decay_remainder_series(Scalar z) {
      constexpr std::array<Scalar, 16> term = decay_remainder_terms();
      const Scalar second = z * z;
      const Scalar fourth = second * second;
      std::array<Scalar, 4> part{};
      for (std::size_t n = 0; n < part.size(); ++n) {
        part[n] =
            (term[4 * n] + term[4 * n + 1] * z) + (term[4 * n + 2] + term[4 * n + 3] * z) * second;
      }
      return (part[0] + part[1] * fourth) + (part[2] + part[3] * fourth) * (fourth * fourth);
    }

    /// (-1)^n / (n + 2)!
    static constexpr std::array<Scalar, 16> decay_remainder_terms() {
      std::array<Scalar, 16> terms{};
      double term = 0.5;
      for (std::size_t n = 0; n < terms.size(); ++n) {
        terms[n] = numeric::from_real<Scalar>(term);
        term /= -static_cast<double>(n + 3);
      }
      return terms;
    }

    Scalar contact_stiffness_;
    Scalar direction_;
    Scalar friction_;
    Scalar decay_;  ///< -kappa s
    Scalar gap_;    ///< g = phi - s at the beginning
  };
};

}  // namespace sonoglide::friction
