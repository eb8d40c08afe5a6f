/// The plant of a scene in either precision: its friction law, with damping and drive whether they
/// are zero or not.
#pragma once

#include <stdexcept>
#include <type_traits>
#include <variant>

#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/sliding.hpp"
#include "host_sim/configure/plant_model.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability {
/// Calls visitor(model) with the plant::Model of an open-loop scene.
/// @throws std::logic_error  no random scene has this law, nor has a map
template <class Scalar, class Visitor>
TrialResult with_model(const scene::Scene& scene, const scene::PlantScales& scales,
                       const Visitor& visitor) {
  const configure::PlantNumbers numbers = configure::plant_numbers(scene, scales);
  return std::visit(
      [&](const auto& law) -> TrialResult {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (Law::random_percent > 0) {
          return visitor(
              configure::plant_model<Scalar, plant::Damped, plant::CosineDrive,
                                     plant::LinearSliding>(law, scene.friction, scales, numbers));
        } else {
          throw std::logic_error("no random scene has this friction law");
        }
      },
      configure::acting_law(scene.friction));
}

}  // namespace sonoglide::stability
