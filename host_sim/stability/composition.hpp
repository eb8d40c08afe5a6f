/// The plant of a scene in either precision: its friction law, with damping and drive whether they
/// are zero or not.
#pragma once

#include <variant>

#include "firmware/friction/coulomb.hpp"
#include "firmware/friction/dahl.hpp"
#include "firmware/friction/none.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "host_sim/scene/plant_scales.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::stability {
namespace detail {

template <class Scalar>
plant::Contact<friction::None<Scalar>> contact(friction::None<Scalar> /*law*/,
                                               const scene::PlantNumbers& /*numbers*/,
                                               Scalar /*sign*/) {
  return {};
}
template <class Scalar>
plant::Contact<friction::Coulomb<Scalar>> contact(friction::Coulomb<Scalar> /*law*/,
                                                  const scene::PlantNumbers& numbers, Scalar sign) {
  return {{}, static_cast<Scalar>(numbers.friction_force), sign};
}
template <class Scalar>
plant::Contact<friction::Dahl<Scalar>> contact(friction::Dahl<Scalar> /*law*/,
                                               const scene::PlantNumbers& numbers, Scalar sign) {
  return {{static_cast<Scalar>(numbers.contact_stiffness)},
          static_cast<Scalar>(numbers.friction_force),
          sign};
}

template <class Scalar>
std::variant<friction::None<Scalar>, friction::Coulomb<Scalar>, friction::Dahl<Scalar>> law_of(
    const scene::Friction& friction) {
  // Without a friction force there is no friction, whatever the law.
  if (scene::friction_limit_N(friction) > 0.0) {
    if (friction.law == scene::FrictionLaw::dahl) {
      return friction::Dahl<Scalar>{};
    }
    if (friction.law == scene::FrictionLaw::coulomb) {
      return friction::Coulomb<Scalar>{};
    }
  }
  return friction::None<Scalar>{};
}

}  // namespace detail

/// Calls visitor(model) with the plant::Model of an open-loop scene.
template <class Scalar, class Visitor>
auto with_model(const scene::Scene& scene, const scene::PlantScales& scales,
                const Visitor& visitor) {
  const scene::PlantNumbers numbers = scene::plant_numbers(scene, scales);
  const auto sign = static_cast<Scalar>(scene::vibration_sign(scene.friction.sign_convention));
  return std::visit(
      [&](auto law) {
        using Model = plant::Model<decltype(law), plant::Damped<Scalar>, plant::CosineDrive>;
        return visitor(Model{detail::contact(law, numbers, sign),
                             {static_cast<Scalar>(numbers.damping)},
                             static_cast<Scalar>(numbers.stiffness)});
      },
      detail::law_of<Scalar>(scene.friction));
}

}  // namespace sonoglide::stability
