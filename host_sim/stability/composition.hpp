/// The plant of a scene in either precision: its friction law, with damping and drive whether they
/// are zero or not.
#pragma once

#include <stdexcept>
#include <type_traits>
#include <variant>

#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "host_sim/scene/plant_contact.hpp"
#include "host_sim/scene/plant_scales.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/stability/trial.hpp"

namespace sonoglide::stability {
/// Calls visitor(model) with the plant::Model of an open-loop scene.
/// @throws std::logic_error  no random scene has this law, nor has a map
template <class Scalar, class Visitor>
TrialResult with_model(const scene::Scene& scene, const scene::PlantScales& scales,
                       const Visitor& visitor) {
  const scene::PlantNumbers numbers = scene::plant_numbers(scene, scales);
  return std::visit(
      [&](const auto& law) -> TrialResult {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (Law::random_percent > 0) {
          using Model = plant::Model<typename Law::template Core<Scalar>, plant::Damped<Scalar>,
                                     plant::CosineDrive>;
          return visitor(Model{scene::plant_contact<Scalar>(law, scene.friction, scales, numbers),
                               {static_cast<Scalar>(numbers.damping)},
                               static_cast<Scalar>(numbers.stiffness)});
        } else {
          throw std::logic_error("no random scene has this friction law");
        }
      },
      scene::acting_law(scene.friction));
}

}  // namespace sonoglide::stability
