/// A scene's plant as a composition of the core: the only place that composes one.
#pragma once

#include <type_traits>

#include "firmware/plant/contact.hpp"
#include "firmware/plant/model.hpp"
#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::configure {

/// @param law  the acting one: laws::None where there is no friction force
template <class Scalar, class Law>
plant::Contact<typename Law::template Core<Scalar>> plant_contact(
    const Law& law, const scene::ContactValues& contact, const scene::PlantScales& scales,
    const PlantNumbers& numbers) {
  if constexpr (std::is_same_v<Law, scene::laws::None>) {
    return {};
  } else if constexpr (Law::template Core<Scalar>::vibration != friction::Vibration::along) {
    return {law.template core<Scalar>(contact, scales),
            static_cast<Scalar>(numbers.friction_force)};
  } else {
    return {law.template core<Scalar>(contact, scales), static_cast<Scalar>(numbers.friction_force),
            static_cast<Scalar>(vibration_sign(contact.sign_convention))};
  }
}

/// @tparam Damping  plant::Damped, or plant::Undamped where the scene has no damping
template <class Scalar, template <class> class Damping, class Drive, class Sliding, class CoreLaw>
plant::Model<CoreLaw, Damping<Scalar>, Drive, Sliding> plant_model(
    const plant::Contact<CoreLaw>& contact, const PlantNumbers& numbers) {
  Damping<Scalar> damping;
  if constexpr (std::is_same_v<Damping<Scalar>, plant::Damped<Scalar>>) {
    damping.damping = static_cast<Scalar>(numbers.damping);
  }
  return {contact, damping, static_cast<Scalar>(numbers.stiffness)};
}

/// The same with the law as the scene has it.
template <class Scalar, template <class> class Damping, class Drive, class Sliding, class Law>
auto plant_model(const Law& law, const scene::ContactValues& contact,
                 const scene::PlantScales& scales, const PlantNumbers& numbers) {
  return plant_model<Scalar, Damping, Drive, Sliding>(
      plant_contact<Scalar>(law, contact, scales, numbers), numbers);
}

/// The plant of a scene with a load.
template <class Drive, class Law>
auto loaded_plant_model(const Law& law, const scene::Scene& scene, const scene::PlantScales& scales,
                        const PlantNumbers& numbers) {
  using Core = typename Law::template Core<double>;
  using Plain = plant::Model<Core, plant::Damped<double>, Drive, plant::MovingBody>;
  const LoadNumbers load = load_numbers(*scene.load, scene.plant.mass_kg, scales);
  const Plain plain = {plant_contact<double>(law, scene.friction, scales, numbers),
                       {numbers.damping},
                       numbers.stiffness};
  return plant::LoadedModel<Core, plant::Damped<double>, Drive>{plain, load.mass_ratio,
                                                                load.damping, load.stiffness};
}

}  // namespace sonoglide::configure
