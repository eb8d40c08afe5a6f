/// Friction of springs in parallel that each slip at a limit of their own: the Iwan law.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Iwan friction: n Jenkins elements side by side, each a spring in series with a dry slider.
///
///              kappa/n     q_1
///         +---/\/\/\/---[slider]---+
///     u --+---/\/\/\/---[slider]---+-- ground
///         +---/\/\/\/---[slider]---+
///              kappa/n     q_n
///
///   d phi_i / d tau = (kappa / n) V while |phi_i| < q_i, 0 while it slips;  phi = sum of phi_i,
///   q_i = (2 i - 1) / n^2, i = 1 ... n.
///
/// With these limits the first load consists of n + 1 straight lines. At their corners it meets
/// Iwan's uniform distribution, phi = kappa u - (kappa u)^2 / 4. It is at its limit from
/// u = (2 n - 1) / (n kappa) on. One element is a spring that slips at Fc. |phi_i| <= q_i always,
/// and so |phi| <= 1.
/// Passive: an element stores phi_i^2 n / (2 kappa), and slip only takes energy; the work done on
/// the contact is never less than minus the stored energy.
/// A vibration of amplitude Y about a slow slide, r -> 0, leaves the friction
///   sum of (q_i - Y kappa / n)_+,
/// which for one element is (1 - kappa Y)_+. So friction does not vanish, as it does with Dahl and
/// Coulomb. Limit: Coulomb as kappa grows.
/// Not modelled: creep at constant load, wear, a normal force that varies, stick without travel.
/// What the members mean is listed in friction/law.hpp.
/// Source: Iwan 1966 (README.md).
template <class Number>
struct Iwan {
  using Scalar = Number;
  static constexpr std::size_t most_elements = 8;
  using Memory = std::array<Scalar, most_elements>;  ///< phi_i; those beyond n are 0
  static constexpr Vibration vibration = Vibration::along;
  static constexpr bool reverses = true;
  static constexpr bool varies = true;
  static constexpr bool sticks = false;
  static constexpr bool rate_independent = true;
  static constexpr bool remembers = true;
  static constexpr bool has_corners = true;

  Scalar contact_stiffness = Scalar(1);  ///< kappa = Kt L / Fc [-], > 0: of all springs together
  std::size_t elements = 1;              ///< n, 1 to most_elements

  Scalar friction(Scalar /*velocity*/, const Memory& forces) const {
    Scalar sum = Scalar(0);
    for (std::size_t i = 0; i < elements; ++i) {
      sum += forces[i];
    }
    return sum;
  }
  Scalar series_unit(Scalar /*velocity*/, const Memory& /*forces*/, Scalar longest) const {
    return longest;
  }
  Memory largest_memory() const {
    Memory limits{};
    for (std::size_t i = 0; i < elements; ++i) {
      limits[i] = slip_limit(i);
    }
    return limits;
  }
  /// Memory after a first load to this friction: the springs are equal and share it until they
  /// slip.
  Memory memory_at(Scalar friction) const {
    Memory forces{};
    Scalar left = friction;
    for (std::size_t i = 0; i < elements; ++i) {
      const Scalar limit = slip_limit(i);
      forces[i] = numeric::clamp(left / static_cast<Scalar>(elements - i), -limit, limit);
      left -= forces[i];
    }
    return forces;
  }
  Scalar element_stiffness() const { return contact_stiffness / static_cast<Scalar>(elements); }
  /// q_i, i from 0.
  Scalar slip_limit(std::size_t i) const {
    return static_cast<Scalar>(2 * i + 1) / static_cast<Scalar>(elements * elements);
  }

  /// Straight in the displacement up to the corner where the next element slips.
  class Arc {
   public:
    /// direction 0 holds the forces where they are. An element within rounding of its limit slips.
    Arc(const Iwan& law, Scalar direction, const Memory& forces)
        : law_(law), direction_(direction), forces_(forces) {
      const Scalar stiffness = law.element_stiffness();
      for (std::size_t i = 0; i < law.elements && direction != Scalar(0); ++i) {
        const Scalar limit = law.slip_limit(i);
        const Scalar left = limit - direction * forces[i];
        if (left > rounding * limit) {
          slope_ += stiffness;
          to_corner_ = numeric::min(to_corner_, left / stiffness);
        }
      }
    }

    template <std::size_t N, class Travel, class Coefficients>
    Scalar coefficient(const Travel& travel, const Coefficients& /*earlier*/) const {
      if constexpr (N == 0) {
        return law_.friction(direction_, forces_);
      } else {
        return slope_ * numeric::from_real<Scalar>(1.0 / static_cast<double>(N)) * travel[N - 1];
      }
    }
    Scalar to_corner() const { return to_corner_; }
    Scalar friction_after(Scalar displacement) const {
      return law_.friction(direction_, memory_after(displacement));
    }
    template <class Numbers>
    Numbers friction_along(Numbers displacement) const {
      return law_.friction(direction_, forces_) + (direction_ * slope_) * displacement;
    }
    Scalar work(Scalar displacement) const {
      const Scalar stiffness = law_.element_stiffness();
      Scalar sum = Scalar(0);
      for (std::size_t i = 0; i < law_.elements; ++i) {
        const Scalar along = direction_ * forces_[i];
        const Scalar limit = law_.slip_limit(i);
        const Scalar stretch = numeric::min(displacement, (limit - along) / stiffness);
        sum += stretch * (along + numeric::half(stiffness * stretch)) +
               limit * (displacement - stretch);
      }
      return sum;
    }
    Memory memory_after(Scalar displacement) const {
      Memory forces = forces_;
      const Scalar pull = direction_ * law_.element_stiffness() * displacement;
      for (std::size_t i = 0; i < law_.elements; ++i) {
        const Scalar limit = law_.slip_limit(i);
        forces[i] = numeric::clamp(forces[i] + pull, -limit, limit);
      }
      return forces;
    }

   private:
    /// A corner is met within some roundings of the travel, and of the force.
    static constexpr Scalar rounding = Scalar(16) * std::numeric_limits<Scalar>::epsilon();

    const Iwan& law_;
    Scalar direction_;
    Memory forces_;
    Scalar slope_ = Scalar(0);  ///< d phi / du
    Scalar to_corner_ = std::numeric_limits<Scalar>::infinity();
  };
};

}  // namespace sonoglide::friction
