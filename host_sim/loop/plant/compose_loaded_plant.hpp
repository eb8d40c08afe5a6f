/// The plants of one friction law with a load: a body of its own mass that slides.
#pragma once

#include <memory>
#include <stdexcept>
#include <type_traits>

#include "firmware/plant/drive.hpp"
#include "firmware/plant/ramped_cosine.hpp"
#include "host_sim/configure/plant_model.hpp"
#include "host_sim/loop/plant/compose_plant.hpp"

namespace sonoglide::loop {

/// A plant with a load always has the damped composition.
template <class Drive, class Law>
std::unique_ptr<PlantPort> loaded_plant(const PlantDescription& description, const Law& law) {
  const scene::Scene& scene = description.scene;
  const auto model =
      configure::loaded_plant_model<Drive>(law, scene, description.scales, description.numbers);
  return find_solver<std::decay_t<decltype(model)>>(scene.solver)(description, model);
}

template <class Law>
std::unique_ptr<PlantPort> make_loaded_plant(const PlantDescription& description, const Law& law) {
  if constexpr (Law::template Core<double>::vibration != friction::Vibration::along) {
    throw std::logic_error("no load slides with this friction law");
  } else {
    const scene::Scene& scene = description.scene;
    return scene.drive && scene.drive->is_straight()
               ? loaded_plant<plant::StraightDrive>(description, law)
               : loaded_plant<plant::RampedCosineDrive>(description, law);
  }
}

}  // namespace sonoglide::loop
