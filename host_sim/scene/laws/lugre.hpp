/// LuGre friction in a scene.
#pragma once

#include <string_view>

#include "firmware/numeric/float_elementary.hpp"
#include "host_sim/scene/contact.hpp"

namespace sonoglide::friction {
template <class Number>
struct LuGre;
}

namespace sonoglide::scene::laws {

/// What friction::LuGre has beyond the Dahl law. What the other members mean is listed at
/// laws::None.
struct LuGre {
  static constexpr std::string_view name = "lugre";
  template <class Scalar>
  using Core = friction::LuGre<Scalar>;
  static constexpr bool elastic = true;
  static constexpr FrictionMap map = FrictionMap::tabulated;
  static constexpr bool is_bounded = false;
  static constexpr std::string_view bound_broken = "the bristles' force > Fs";

  double static_coefficient = 0.0;
  double stribeck_velocity_m_per_s = 0.0;
  double bristle_damping_N_s_per_m = 0.0;
  double viscous_friction_N_s_per_m = 0.0;

  template <class Keys>
  void visit_keys(Keys& keys, const ContactValues& contact) {
    keys.required("static_coefficient", static_coefficient, {contact.coefficient, 100.0},
                  "friction coefficient at rest, at least coefficient");
    keys.required("stribeck_velocity_m_per_s", stribeck_velocity_m_per_s, {1e-9, 1e6, "m/s"},
                  "sliding velocity over which static friction falls to sliding friction");
    keys.optional("bristle_damping_N_s_per_m", bristle_damping_N_s_per_m, {0.0, 1e12, "N s/m"},
                  "damping of the bristles");
    keys.optional("viscous_friction_N_s_per_m", viscous_friction_N_s_per_m, {0.0, 1e12, "N s/m"},
                  "viscous coefficient: friction force added per sliding velocity");
  }

  /// N (mu + (mu_s - mu) exp(-(v/v_s)^2)) + sigma2 v
  double undriven_N(const ContactValues& contact, double speed_m_per_s) const {
    const double part = speed_m_per_s / stribeck_velocity_m_per_s;
    const double coefficient = contact.coefficient + (static_coefficient - contact.coefficient) *
                                                         numeric::exp(-part * part);
    return coefficient * contact.normal_force_N + viscous_friction_N_s_per_m * speed_m_per_s;
  }

  template <class Scalar>
  Core<Scalar> core(const ContactValues& contact, const PlantScales& scales) const {
    const double force_per_velocity = scales.velocity_m_per_s() / scales.friction_N;
    return {static_cast<Scalar>(scales.contact_stiffness(contact.contact_stiffness_N_per_m)),
            static_cast<Scalar>(static_coefficient / contact.coefficient),
            static_cast<Scalar>(stribeck_velocity_m_per_s / scales.velocity_m_per_s()),
            static_cast<Scalar>(bristle_damping_N_s_per_m * force_per_velocity),
            static_cast<Scalar>(viscous_friction_N_s_per_m * force_per_velocity)};
  }
};

}  // namespace sonoglide::scene::laws
