/// Dry friction of a contact that vibrates across the sliding.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/float_sqrt.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Coulomb friction in the plane of the contact: magnitude Fc, against the slip (r, v).
///
///      v |     slip (r, v)
///        |   /
///        | /          friction has the modulus 1 and points the other way
///        +--------- r, along the sliding
///
///   along the sliding    phi = r / sqrt(r^2 + v^2), the friction that the ratio is the mean of;
///   on the oscillator    v / sqrt(r^2 + v^2).
///
/// r = Vt / (omega L) and v = dy / d tau are the slip along and across. Smooth wherever they are
/// not both 0: nothing reverses, and friction along the sliding is never negative work.
/// Passive: the power taken is sqrt(r^2 + v^2) >= 0. Under y = sin tau the mean of phi is
/// transverse_vibration_ratio(r).
/// Not modelled: a contact at rest, r = v = 0, which may hold by any |phi| <= 1; presliding
/// displacement, for which the measured ratio is the higher; a limit that depends on the direction.
/// No parameter and no state. What the members mean is listed in friction/law.hpp.
/// Source: Storck 2002 (README.md).
template <class Number>
struct TransverseCoulomb {
  using Scalar = Number;
  static constexpr Vibration vibration = Vibration::across;
  static constexpr bool reverses = false;
  static constexpr bool varies = true;
  static constexpr bool sticks = false;
  static constexpr bool rate_independent = false;
  static constexpr bool remembers = false;
  static constexpr bool has_corners = false;

  struct Slip {
    Scalar along;   ///< r
    Scalar across;  ///< v

    Scalar speed() const { return numeric::sqrt(along * along + across * across); }
  };

  Scalar friction(const Slip& slip, Scalar /*last_friction*/) const {
    return share(slip.along, slip);
  }
  Scalar friction_across(const Slip& slip) const { return share(slip.across, slip); }
  Scalar rate(const Slip& /*slip*/, Scalar /*friction*/) const { return Scalar(0); }
  /// A slow slip soon turns its direction, and the series is valid for no longer than that takes.
  Scalar series_unit(const Slip& slip, Scalar /*friction*/, Scalar longest) const {
    constexpr Scalar shortest = numeric::power_of_two<Scalar>(-8);
    return numeric::min(longest, numeric::max(shortest, numeric::twice(slip.speed())));
  }
  /// The series converge while the slip changes by less than its speed. Without slip across there
  /// is no friction across; a sliding velocity that passes 0 then does so in one short step.
  Scalar reach(const Slip& slip) const {
    constexpr Scalar passing = numeric::power_of_two<Scalar>(-20);
    const Scalar near = numeric::half(slip.speed());
    return slip.across == Scalar(0) ? numeric::max(near, passing) : near;
  }

  /// From the square S of the speed: 1 / speed = S^(-1/2), by S (S^a)' = a S' S^a.
  template <std::size_t Order>
  class Series {
   public:
    using Coefficients = std::array<Scalar, Order + 1>;

    Series(const TransverseCoulomb& law, Scalar /*direction*/, Scalar /*friction*/) : law_(law) {}

    /// N-th coefficient of the friction across, from those of v and r.
    template <std::size_t N>
    Scalar coefficient(Scalar across, Scalar along) {
      across_[N] = across;
      along_[N] = along;
      square_[N] = product(across_, across_, N) + product(along_, along_, N);
      if (!(square_[0] > Scalar(0))) {
        // Passing through rest. Staying there is not modelled: the series is then not finite.
        per_speed_[N] = N == 1 ? Scalar(0) / along : Scalar(0);
      } else if constexpr (N == 0) {
        per_speed_[0] = Scalar(1) / numeric::sqrt(square_[0]);
      } else {
        Scalar sum = Scalar(0);
        for (std::size_t j = 1; j <= N; ++j) {
          sum += (static_cast<Scalar>(N) - numeric::half(static_cast<Scalar>(j))) * square_[j] *
                 per_speed_[N - j];
        }
        per_speed_[N] = -sum / (static_cast<Scalar>(N) * square_[0]);
      }
      return product(across_, per_speed_, N);
    }

    /// phi, and the power taken, at a slip.
    Scalar friction(Scalar along, Scalar across) const {
      return law_.friction({along, across}, Scalar(0));
    }
    Scalar power(Scalar along, Scalar across) const { return Slip{along, across}.speed(); }

    /// The n-th coefficient of phi.
    Scalar friction_along(std::size_t n) const {
      const Scalar steady = along_[0] * per_speed_[n];
      return n == 0 ? steady : steady + along_[1] * per_speed_[n - 1];
    }

   private:
    static Scalar product(const Coefficients& a, const Coefficients& b, std::size_t n) {
      Scalar sum = Scalar(0);
      for (std::size_t j = 0; j <= n; ++j) {
        sum += a[j] * b[n - j];
      }
      return sum;
    }

    const TransverseCoulomb& law_;
    Coefficients across_{};     ///< v
    Coefficients along_{};      ///< r
    Coefficients square_{};     ///< S
    Coefficients per_speed_{};  ///< 1 / sqrt(S)
  };

 private:
  static Scalar share(Scalar part, const Slip& slip) {
    const Scalar speed = slip.speed();
    return speed > Scalar(0) ? part / speed : Scalar(0);
  }
};

}  // namespace sonoglide::friction
