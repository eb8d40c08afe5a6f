/// Friction of a contact that vibrates normally to the surface, in a scene.
#pragma once

#include <string_view>

#include "host_sim/scene/contact.hpp"

namespace sonoglide::friction {
template <class Number>
struct NormalCoulomb;
}

namespace sonoglide::scene::laws {

/// What friction::NormalCoulomb has beyond the stiffness along the sliding, which is the contact's.
/// What the other members mean is listed at laws::None.
struct NormalCoulomb {
  static constexpr std::string_view name = "normal_coulomb";
  template <class Scalar>
  using Core = friction::NormalCoulomb<Scalar>;
  static constexpr bool elastic = true;
  static constexpr FrictionMap map = FrictionMap::tabulated;
  static constexpr bool is_bounded = false;

  double normal_contact_stiffness_N_per_m = 0.0;  ///< kz

  template <class Keys>
  void visit_keys(Keys& keys, const ContactValues& /*contact*/) {
    keys.required("normal_contact_stiffness_N_per_m", normal_contact_stiffness_N_per_m,
                  {1e-6, 1e18, "N/m"}, "stiffness of the contact normal to the surface");
  }

  double undriven_N(const ContactValues& contact, double /*speed_m_per_s*/) const {
    return contact.limit_N();
  }

  template <class Scalar>
  Core<Scalar> core(const ContactValues& contact, const PlantScales& scales) const {
    return {static_cast<Scalar>(scales.contact_stiffness(contact.contact_stiffness_N_per_m)),
            static_cast<Scalar>(normal_contact_stiffness_N_per_m * scales.length_m /
                                contact.normal_force_N)};
  }
};

}  // namespace sonoglide::scene::laws
