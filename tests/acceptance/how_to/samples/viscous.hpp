/// Viscous friction in a scene: the sample of "How to add a friction law".
#pragma once

#include <string_view>

#include "host_sim/scene/contact.hpp"

namespace sonoglide::friction {
template <class Number>
struct Viscous;
}

namespace sonoglide::scene::laws {

/// What the members mean is listed at laws::None.
struct Viscous {
  static constexpr std::string_view name = "viscous";
  template <class Scalar>
  using Core = friction::Viscous<Scalar>;
  static constexpr bool elastic = false;
  static constexpr FrictionMap map = FrictionMap::tabulated;
  static constexpr bool is_bounded = false;

  double film_s_per_m = 0.0;  ///< c: F = mu N c V

  template <class Keys>
  void visit_keys(Keys& keys, const ContactValues& /*contact*/) {
    keys.required("film_s_per_m", film_s_per_m, {1e-9, 1e9, "s/m"},
                  "friction force over coefficient * normal_force_N, per sliding velocity");
  }

  double undriven_N(const ContactValues& contact, double speed_m_per_s) const {
    return contact.limit_N() * film_s_per_m * speed_m_per_s;
  }

  template <class Scalar>
  Core<Scalar> core(const ContactValues& /*contact*/, const PlantScales& scales) const {
    return {static_cast<Scalar>(film_s_per_m * scales.velocity_m_per_s())};
  }
};

}  // namespace sonoglide::scene::laws
