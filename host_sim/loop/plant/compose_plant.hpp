/// The plants of one friction law, each composed of what a scene names: chosen once, before the
/// loop.
#pragma once

#include <memory>
#include <type_traits>

#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "host_sim/configure/plant_model.hpp"
#include "host_sim/loop/plant/plant_description.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/loop/plant/sliding_profile.hpp"
#include "host_sim/loop/plant/solver_list.hpp"

namespace sonoglide::loop {

template <template <class> class Damping, class Drive, class Sliding, class Law>
std::unique_ptr<PlantPort> with_solver(const PlantDescription& description, const Law& law) {
  const auto model = configure::plant_model<double, Damping, Drive, Sliding>(
      law, description.scene.friction, description.scales, description.numbers);
  return find_solver<std::decay_t<decltype(model)>>(description.scene.solver)(description, model);
}

/// One composition serves every rare scene: it always uses the damped plant, whose damping is 0 if
/// the scene has none, and a sliding velocity that may change.
template <class Drive, class Law>
std::unique_ptr<PlantPort> general_plant(const PlantDescription& description, const Law& law) {
  return with_solver<plant::Damped, Drive, plant::LinearSliding>(description, law);
}

/// A cosine and one sliding velocity, as in most scenes: the plant has no part that the scene does
/// not name. A scene without a drive has a cosine of amplitude 0.
template <class Law>
std::unique_ptr<PlantPort> lean_plant(const PlantDescription& description, const Law& law) {
  if (!(description.numbers.damping > 0.0)) {
    return with_solver<plant::Undamped, plant::CosineDrive, plant::ConstantSliding>(description,
                                                                                    law);
  }
  return with_solver<plant::Damped, plant::CosineDrive, plant::ConstantSliding>(description, law);
}

/// The laws whose plants take a tenth more time or so with parts that a scene does not name. With the
/// others it is less, and one composition for all scenes is enough.
template <class Law>
inline constexpr bool is_quick_law =
    std::is_same_v<Law, scene::laws::Dahl> || std::is_same_v<Law, scene::laws::Coulomb> ||
    std::is_same_v<Law, scene::laws::Iwan>;

template <class Law>
std::unique_ptr<PlantPort> make_law_plant(const PlantDescription& description, const Law& law) {
  const scene::Scene& scene = description.scene;
  switch (scene.drive ? scene.drive->waveform : scene::Waveform::cosine) {
    case scene::Waveform::square:
      return general_plant<plant::LevelDrive>(description, law);
    case scene::Waveform::triangle:
    case scene::Waveform::sawtooth:
      return general_plant<plant::RampDrive>(description, law);
    case scene::Waveform::cosine:
      break;
  }
  if constexpr (is_quick_law<Law>) {
    if (SlidingProfile(scene.sliding).is_constant() && composed_lean(scene.solver.method)) {
      return lean_plant(description, law);
    }
  }
  return general_plant<plant::CosineDrive>(description, law);
}

}  // namespace sonoglide::loop
