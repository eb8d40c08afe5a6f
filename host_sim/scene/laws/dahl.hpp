/// Dahl friction in a scene.
#pragma once

#include <string_view>

#include "host_sim/scene/contact.hpp"

namespace sonoglide::friction {
template <class Number>
struct Dahl;
}

namespace sonoglide::scene::laws {

/// What the members mean is listed at laws::None.
struct Dahl {
  static constexpr std::string_view name = "dahl";
  template <class Scalar>
  using Core = friction::Dahl<Scalar>;
  static constexpr bool elastic = true;
  static constexpr FrictionMap map = FrictionMap::dahl;
  static constexpr bool is_bounded = true;

  template <class Keys>
  void visit_keys(Keys& /*keys*/, const ContactValues& /*contact*/) {}

  double undriven_N(const ContactValues& contact, double /*speed_m_per_s*/) const {
    return contact.limit_N();
  }

  template <class Scalar>
  Core<Scalar> core(const ContactValues& contact, const PlantScales& scales) const {
    return {static_cast<Scalar>(scales.contact_stiffness(contact.contact_stiffness_N_per_m))};
  }
};

}  // namespace sonoglide::scene::laws
