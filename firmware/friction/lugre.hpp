/// Friction of bristles that bend, slip and lag: the LuGre law.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// LuGre friction: the mean force of the bristles, psi, relaxes to a Stribeck curve g.
///
///         +--- sigma0 spring --+
///     V --+--- sigma1 damper --+-- [slider g(V)] --+-- ground
///         |                                        |
///         +------------ sigma2 damper -------------+
///
///   d psi / d tau = kappa (V - |V| psi / g(V)),   g(V) = 1 + (gamma - 1) exp(-(V / nu)^2),
///   phi = psi + delta (V - |V| psi / g(V)) + eta V.
///
/// In SI units, z the bristles' mean deflection: dz/dt = V - sigma0 |V| z / G(V) and
/// F = sigma0 z + sigma1 dz/dt + sigma2 V, with G = g Fc and psi = sigma0 z / Fc.
/// |psi| <= gamma always, as g <= gamma; phi has no such bound.
/// Passive where eta >= delta (gamma - 1): then phi V - d(psi^2 / 2 kappa) / d tau
///   = |V| (psi^2 / g + |V| (delta + eta - delta s psi / g)) >= 0, as s psi <= gamma and g >= 1, so
/// that the work done on the contact is never less than -psi^2 / (2 kappa).
/// Limits: gamma = 1, delta = eta = 0 is Dahl; then kappa to infinity is Coulomb. Steady sliding
/// has phi = g(V) sgn V + eta V. With gamma = 1 a periodic motion has the mean friction of Dahl
/// plus eta times the mean of V: psi returns after a period, so the mean of the delta term is 0.
/// Not modelled: stick that does not creep, a delta that fades with the speed, a normal force that
/// varies, friction lag apart from that of the bristles.
/// What the members mean is listed in friction/law.hpp.
/// Source: Canudas de Wit 1995, section II (README.md).
template <class Number>
struct LuGre {
  using Scalar = Number;
  using Memory = Scalar;  ///< psi
  static constexpr Vibration vibration = Vibration::along;
  static constexpr bool reverses = true;
  static constexpr bool varies = true;
  static constexpr bool sticks = false;
  static constexpr bool rate_independent = false;
  static constexpr bool remembers = true;
  static constexpr bool has_corners = false;

  Scalar contact_stiffness = Scalar(1);  ///< kappa = sigma0 L / Fc [-], > 0
  Scalar static_friction = Scalar(1);    ///< gamma = Fs / Fc [-], >= 1
  Scalar stribeck_velocity = Scalar(1);  ///< nu = vs / (omega L) [-], > 0
  Scalar bristle_damping = Scalar(0);    ///< delta = sigma1 omega L / Fc [-], >= 0
  Scalar viscous_friction = Scalar(0);   ///< eta = sigma2 omega L / Fc [-], >= 0

  Scalar friction(Scalar velocity, Memory bristles) const {
    return bristles + bristle_damping * bending(velocity, bristles) + viscous_friction * velocity;
  }
  /// Of psi.
  Scalar rate(Scalar velocity, Memory bristles) const {
    return contact_stiffness * bending(velocity, bristles);
  }
  Memory largest_memory() const { return static_friction; }
  Memory memory_at(Scalar friction) const { return friction; }
  Scalar series_unit(Scalar velocity, Memory /*bristles*/, Scalar longest) const {
    const Scalar moderate = Scalar(16);
    const Scalar rate = contact_stiffness * numeric::abs(velocity);
    return longest * (rate + contact_stiffness * longest) <= moderate
               ? longest
               : numeric::min(longest, moderate / (Scalar(1) + rate));
  }
  /// Far from V = 0 the Taylor terms of g do not show that g rises there. Beyond 6 nu g is flat.
  Scalar reach(Scalar velocity) const {
    return numeric::max(numeric::half(stribeck_velocity),
                        numeric::abs(velocity) - Scalar(6) * stribeck_velocity);
  }

  /// Each factor of the law has a series of its own, in terms of those before it.
  template <std::size_t Order>
  class Series {
   public:
    Series(const LuGre& law, Scalar direction, Memory bristles) : law_(law), direction_(direction) {
      bristles_[0] = bristles;
    }

    template <std::size_t N, class Travel>
    Scalar coefficient(const Travel& travel, Scalar unit) {
      velocity_[N] = travel[N] / unit;
      add_curve(N);
      share_[N] = bristles_[N];
      for (std::size_t j = 1; j <= N; ++j) {
        share_[N] -= curve_[j] * share_[N - j];
      }
      share_[N] /= curve_[0];
      const Scalar bending = velocity_[N] - direction_ * product(velocity_, share_, N);
      if constexpr (N < Order) {
        constexpr Scalar step = numeric::from_real<Scalar>(1.0 / static_cast<double>(N + 1));
        bristles_[N + 1] = law_.contact_stiffness * (unit * step) * bending;
      }
      return bristles_[N] + law_.bristle_damping * bending + law_.viscous_friction * velocity_[N];
    }

    Memory memory(Scalar x) const {
      Scalar sum = Scalar(0);
      for (std::size_t n = Order + 1; n-- > 0;) {
        sum = sum * x + bristles_[n];
      }
      return sum;
    }

   private:
    using Coefficients = std::array<Scalar, Order + 1>;

    static Scalar product(const Coefficients& a, const Coefficients& b, std::size_t n) {
      Scalar sum = Scalar(0);
      for (std::size_t j = 0; j <= n; ++j) {
        sum += a[j] * b[n - j];
      }
      return sum;
    }

    /// g, from E = exp(-q) with q = (V / nu)^2: E' = -q' E.
    void add_curve(std::size_t n) {
      const Scalar scale = Scalar(1) / law_.stribeck_velocity;
      square_[n] = scale * scale * product(velocity_, velocity_, n);
      if (n == 0) {
        fall_[0] = numeric::exp(-square_[0]);
        curve_[0] = Scalar(1) + (law_.static_friction - Scalar(1)) * fall_[0];
        return;
      }
      Scalar sum = Scalar(0);
      for (std::size_t j = 1; j <= n; ++j) {
        sum += static_cast<Scalar>(j) * square_[j] * fall_[n - j];
      }
      fall_[n] = -sum / static_cast<Scalar>(n);
      curve_[n] = (law_.static_friction - Scalar(1)) * fall_[n];
    }

    const LuGre& law_;
    Scalar direction_;
    Coefficients velocity_{};  ///< V
    Coefficients square_{};    ///< (V / nu)^2
    Coefficients fall_{};      ///< exp of minus that
    Coefficients curve_{};     ///< g
    Coefficients bristles_{};  ///< psi
    Coefficients share_{};     ///< psi / g
  };

 private:
  /// dz / d tau, in units of L.
  Scalar bending(Scalar velocity, Memory bristles) const {
    const Scalar part = velocity / stribeck_velocity;
    const Scalar curve = Scalar(1) + (static_friction - Scalar(1)) * numeric::exp(-part * part);
    return velocity - numeric::abs(velocity) * bristles / curve;
  }
};

}  // namespace sonoglide::friction
