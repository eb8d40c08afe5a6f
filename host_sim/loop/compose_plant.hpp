/// One contact with the damping, the drive and the solver that a scene names: chosen once, before
/// the loop.
#pragma once

#include <memory>
#include <type_traits>

#include "firmware/plant/contact.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/sliding.hpp"
#include "host_sim/loop/law_plants.hpp"
#include "host_sim/loop/plant_description.hpp"
#include "host_sim/loop/plant_port.hpp"
#include "host_sim/loop/sliding_profile.hpp"
#include "host_sim/loop/solver_list.hpp"
#include "host_sim/scene/plant_contact.hpp"

namespace sonoglide::loop {

template <class Drive, class Sliding, class Law, class Damping>
std::unique_ptr<PlantPort> with_solver(const PlantDescription& description,
                                       const plant::Contact<Law>& contact, const Damping& damping) {
  using Model = plant::Model<Law, Damping, Drive, Sliding>;
  return find_solver<Model>(description.scene.solver)(
      description, Model{contact, damping, description.numbers.stiffness});
}

template <class Drive, class Law>
std::unique_ptr<PlantPort> with_damping(const PlantDescription& description,
                                        const plant::Contact<Law>& contact) {
  const double damping = description.numbers.damping;
  // A force that depends on the speed damps anyhow: no composition of it without damping.
  if constexpr (Law::rate_independent) {
    if (!(damping > 0.0)) {
      return with_solver<Drive, plant::ConstantSliding>(description, contact,
                                                        plant::Undamped<double>{});
    }
  }
  return with_solver<Drive, plant::ConstantSliding>(description, contact,
                                                    plant::Damped<double>{damping});
}

/// Few scenes name a sliding speed that changes, or a straight drive: of all those one composition
/// each, damped, be it by nothing, and driven, be it at no amplitude.
template <class Drive, class Law>
std::unique_ptr<PlantPort> with_any_sliding(const PlantDescription& description,
                                            const plant::Contact<Law>& contact) {
  return with_solver<Drive, plant::LinearSliding>(
      description, contact, plant::Damped<double>{description.numbers.damping});
}

template <class Law>
std::unique_ptr<PlantPort> make_law_plant(const PlantDescription& description, const Law& law) {
  const scene::Scene& scene = description.scene;
  const auto contact =
      scene::plant_contact<double>(law, scene.friction, description.scales, description.numbers);
  const bool driven = scene.drive && (scene.drive->force_amplitude_N > 0.0 || scene.controller);
  switch (driven ? scene.drive->waveform : scene::Waveform::cosine) {
    case scene::Waveform::square:
      return with_any_sliding<plant::LevelDrive>(description, contact);
    case scene::Waveform::triangle:
    case scene::Waveform::sawtooth:
      return with_any_sliding<plant::RampDrive>(description, contact);
    case scene::Waveform::cosine:
      break;
  }
  // Without friction nothing depends on the sliding.
  if constexpr (!std::is_same_v<Law, scene::laws::None>) {
    if (!SlidingProfile(scene.sliding).is_constant()) {
      return with_any_sliding<plant::CosineDrive>(description, contact);
    }
  }
  return driven ? with_damping<plant::CosineDrive>(description, contact)
                : with_damping<plant::NoDrive>(description, contact);
}

}  // namespace sonoglide::loop
