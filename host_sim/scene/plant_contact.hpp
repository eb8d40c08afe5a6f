/// From a scene's contact to that of the core.
#pragma once

#include <type_traits>

#include "firmware/plant/contact.hpp"
#include "host_sim/scene/plant_scales.hpp"

namespace sonoglide::scene {

/// @param law  the acting one: laws::None where there is no friction force
template <class Scalar, class Law>
plant::Contact<typename Law::template Core<Scalar>> plant_contact(const Law& law,
                                                                  const Contact& contact,
                                                                  const PlantScales& scales,
                                                                  const PlantNumbers& numbers) {
  if constexpr (std::is_same_v<Law, laws::None>) {
    return {};
  } else if constexpr (Law::template Core<Scalar>::vibration != friction::Vibration::along) {
    return {law.template core<Scalar>(contact, scales),
            static_cast<Scalar>(numbers.friction_force)};
  } else {
    return {law.template core<Scalar>(contact, scales), static_cast<Scalar>(numbers.friction_force),
            static_cast<Scalar>(vibration_sign(contact.sign_convention))};
  }
}

}  // namespace sonoglide::scene
