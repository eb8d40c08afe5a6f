/// Iwan friction in a scene.
#pragma once

#include <cstddef>
#include <string_view>

#include "host_sim/scene/contact.hpp"

namespace sonoglide::friction {
template <class Number>
struct Iwan;
}

namespace sonoglide::scene::laws {

/// Springs in parallel, contact_stiffness_N_per_m together, that each slip. What the other members
/// mean is listed at laws::None.
struct Iwan {
  static constexpr std::string_view name = "iwan";
  template <class Scalar>
  using Core = friction::Iwan<Scalar>;
  static constexpr bool elastic = true;
  static constexpr FrictionMap map = FrictionMap::tabulated;
  static constexpr bool is_bounded = true;
  static constexpr std::string_view bound_broken = "an element's force > its limit";
  static constexpr int most_elements = 8;

  int elements = 1;

  template <class Keys>
  void visit_keys(Keys& keys, const ContactValues& /*contact*/) {
    keys.optional("elements", elements, 1, most_elements,
                  "number of springs in parallel, which slip at graded limits");
  }

  double undriven_N(const ContactValues& contact, double /*speed_m_per_s*/) const {
    return contact.limit_N();
  }

  template <class Scalar>
  Core<Scalar> core(const ContactValues& contact, const PlantScales& scales) const {
    static_assert(most_elements == static_cast<int>(Core<Scalar>::most_elements));
    return {static_cast<Scalar>(scales.contact_stiffness(contact.contact_stiffness_N_per_m)),
            static_cast<std::size_t>(elements)};
  }
};

}  // namespace sonoglide::scene::laws
