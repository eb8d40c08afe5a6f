/// Stribeck friction in a scene.
#pragma once

#include <string_view>

#include "host_sim/scene/contact.hpp"

namespace sonoglide::friction {
template <class Number>
struct Stribeck;
}

namespace sonoglide::scene::laws {

/// What friction::Stribeck has beyond the Coulomb law: mu(v) = mu_s sgn v - alpha v + beta v^3.
/// What the other members mean is listed at laws::None.
struct Stribeck {
  static constexpr std::string_view name = "stribeck";
  template <class Scalar>
  using Core = friction::Stribeck<Scalar>;
  static constexpr bool elastic = false;
  static constexpr FrictionMap map = FrictionMap::tabulated;
  static constexpr bool is_bounded = false;

  double fall_s_per_m = 0.0;    ///< alpha
  double rise_s3_per_m3 = 0.0;  ///< beta

  /// Friction below zero would drive the contact.
  template <class Keys>
  void visit_keys(Keys& keys, const ContactValues& contact) {
    keys.required("fall_s_per_m", fall_s_per_m, {0.0, 1e9, "s/m"},
                  "linear fall of the friction coefficient with the sliding velocity");
    keys.required("rise_s3_per_m3", rise_s3_per_m3, {0.0, 1e27, "s^3/m^3"},
                  "cubic rise of the friction coefficient with the sliding velocity, which keeps "
                  "the friction above 0");
    const double fall_cubed = fall_s_per_m * fall_s_per_m * fall_s_per_m;
    const double square = 27.0 * contact.coefficient * contact.coefficient;
    if (contact.coefficient > 0.0 && rise_s3_per_m3 * square < 4.0 * fall_cubed) {
      keys.refuse("rise_s3_per_m3", rise_s3_per_m3, "lets the friction fall below zero",
                  4.0 * fall_cubed / square, "s^3/m^3 with this fall_s_per_m");
    }
  }

  /// mu(v) N
  double undriven_N(const ContactValues& contact, double speed_m_per_s) const {
    const double v = speed_m_per_s;
    return (contact.coefficient - v * (fall_s_per_m - rise_s3_per_m3 * v * v)) *
           contact.normal_force_N;
  }

  template <class Scalar>
  Core<Scalar> core(const ContactValues& contact, const PlantScales& scales) const {
    const double velocity = scales.velocity_m_per_s();
    return {
        static_cast<Scalar>(fall_s_per_m * velocity / contact.coefficient),
        static_cast<Scalar>(rise_s3_per_m3 * velocity * velocity * velocity / contact.coefficient)};
  }
};

}  // namespace sonoglide::scene::laws
