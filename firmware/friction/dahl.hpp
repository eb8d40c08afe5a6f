/// Presliding friction after Dahl, with its exact solution between two reversals.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Dahl friction: d phi / d tau = kappa (V - |V| phi).
///
/// Between two reversals, with s = sgn V and e = 1 - s phi, the force depends on the displacement
/// alone: e(u) = e(0) exp(-kappa |u|). So |phi| <= 1 always. Passive: the work done on the contact
/// is never less than -phi^2 / (2 kappa). What the members mean is listed at friction::None.
/// Source: P. R. Dahl, A solid friction model, Aerospace Corporation TOR-0158(3107-18)-1, 1968.
template <class Number>
struct Dahl {
  using Scalar = Number;
  static constexpr bool reverses = true;
  static constexpr bool sticks = false;

  Scalar contact_stiffness = Scalar(1);  ///< kappa = Kt L / Fc [-], > 0

  Scalar friction(Scalar /*velocity*/, Scalar last_friction) const { return last_friction; }
  Scalar rate(Scalar velocity, Scalar friction) const {
    return contact_stiffness * (velocity - numeric::abs(velocity) * friction);
  }
  Scalar series_unit(Scalar velocity, Scalar friction) const {
    if (numeric::abs(friction) == Scalar(1) && velocity * friction > Scalar(0)) {
      return Scalar(1);
    }
    return Scalar(1) / (Scalar(1) + contact_stiffness * numeric::abs(velocity));
  }

  template <std::size_t Order>
  class Arc {
   public:
    /// direction 0 holds the friction where it is.
    Arc(const Dahl& law, Scalar direction, Scalar friction)
        : contact_stiffness_(law.contact_stiffness),
          direction_(direction),
          friction_(friction),
          decay_(-law.contact_stiffness * direction) {
      deficit_[0] = Scalar(1) - direction * friction;
    }

    template <class Coefficients>
    Scalar coefficient(std::size_t n, Scalar unit_over_n, const Coefficients& velocity) {
      if (n == 0) {
        return friction_;
      }
      // From the middle outwards: the newest factors enter last, the rest need not wait for them.
      const std::size_t middle = n / 2;
      Scalar sum = n % 2 == 0 ? Scalar(0) : velocity[middle] * deficit_[middle];
      for (std::size_t j = middle; j-- > 0;) {
        const std::size_t mirrored = n - 1 - j;
        sum += velocity[j] * deficit_[mirrored] + velocity[mirrored] * deficit_[j];
      }
      deficit_[n] = (decay_ * unit_over_n) * sum;
      return -direction_ * deficit_[n];
    }
    Scalar magnitude(std::size_t n) const { return numeric::abs(deficit_[n]); }
    Scalar friction_after(Scalar displacement) const {
      return numeric::clamp(friction_ - direction_ * deficit_change(displacement), Scalar(-1),
                            Scalar(1));
    }
    Scalar work(Scalar displacement) const {
      return direction_ * friction_ * displacement +
             deficit_[0] * decay_remainder(contact_stiffness_ * displacement) / contact_stiffness_;
    }

   private:
    Scalar deficit_change(Scalar displacement) const {
      return deficit_[0] * numeric::expm1(-contact_stiffness_ * displacement);
    }

    /// exp(-z) - 1 + z, z >= 0, to full relative accuracy.
    static Scalar decay_remainder(Scalar z) {
      if (z > numeric::from_real<Scalar>(0.5)) {
        return numeric::expm1(-z) + z;
      }
      Scalar sum = Scalar(1);
      for (int n = 15; n > 2; --n) {
        sum = Scalar(1) - z * sum / static_cast<Scalar>(n);
      }
      return numeric::half(z * z) * sum;
    }

    Scalar contact_stiffness_;
    Scalar direction_;
    Scalar friction_;
    Scalar decay_;                           ///< -kappa s
    std::array<Scalar, Order + 1> deficit_;  ///< e = 1 - s phi
  };
};

}  // namespace sonoglide::friction
