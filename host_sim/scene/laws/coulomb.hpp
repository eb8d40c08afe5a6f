/// Coulomb friction in a scene.
#pragma once

#include <string_view>

#include "host_sim/scene/contact.hpp"

namespace sonoglide::friction {
template <class Number>
struct Coulomb;
}

namespace sonoglide::scene::laws {

/// What the members mean is listed at laws::None.
struct Coulomb {
  static constexpr std::string_view name = "coulomb";
  template <class Scalar>
  using Core = friction::Coulomb<Scalar>;
  static constexpr bool elastic = false;
  static constexpr FrictionMap map = FrictionMap::coulomb;
  static constexpr bool is_bounded = true;

  template <class Keys>
  void visit_keys(Keys& /*keys*/, const ContactValues& /*contact*/) {}

  double undriven_N(const ContactValues& contact, double /*speed_m_per_s*/) const {
    return contact.limit_N();
  }

  template <class Scalar>
  Core<Scalar> core(const ContactValues& /*contact*/, const PlantScales& /*scales*/) const {
    return {};
  }
};

}  // namespace sonoglide::scene::laws
