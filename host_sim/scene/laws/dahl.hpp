/// Dahl friction in a scene.
#pragma once

#include <string_view>

#include "firmware/friction/dahl.hpp"
#include "host_sim/scene/contact.hpp"
#include "host_sim/scene/scales.hpp"

namespace sonoglide::scene::laws {

/// What the members mean is listed at laws::None.
struct Dahl {
  static constexpr std::string_view name = "dahl";
  template <class Scalar>
  using Core = friction::Dahl<Scalar>;
  static constexpr bool elastic = true;
  static constexpr FrictionMap map = FrictionMap::dahl;
  static constexpr bool map_is_own = true;
  static constexpr int random_percent = 60;

  template <class Keys>
  void visit_keys(Keys& /*keys*/, const Contact& /*contact*/) {}

  template <class Scalar>
  Core<Scalar> core(const Contact& contact, const PlantScales& scales) const {
    return {static_cast<Scalar>(contact.contact_stiffness_N_per_m * scales.length_m /
                                scales.friction_N)};
  }
};

}  // namespace sonoglide::scene::laws
