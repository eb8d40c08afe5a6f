/// One contact with the damping, the drive and the solver that a scene names: chosen once, before
/// the loop.
#pragma once

#include <memory>

#include "firmware/plant/contact.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "host_sim/loop/law_plants.hpp"
#include "host_sim/loop/plant_description.hpp"
#include "host_sim/loop/plant_port.hpp"
#include "host_sim/loop/solver_list.hpp"
#include "host_sim/scene/plant_contact.hpp"

namespace sonoglide::loop {

template <class Drive, class Law, class Damping>
std::unique_ptr<PlantPort> with_solver(const PlantDescription& description,
                                       const plant::Contact<Law>& contact, const Damping& damping) {
  using Model = plant::Model<Law, Damping, Drive>;
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
      return with_solver<Drive>(description, contact, plant::Undamped<double>{});
    }
  }
  return with_solver<Drive>(description, contact, plant::Damped<double>{damping});
}

template <class Law>
std::unique_ptr<PlantPort> make_law_plant(const PlantDescription& description, const Law& law) {
  const scene::Scene& scene = description.scene;
  const auto contact =
      scene::plant_contact<double>(law, scene.friction, description.scales, description.numbers);
  const bool driven = scene.drive && (scene.drive->force_amplitude_N > 0.0 || scene.controller);
  if (!driven) {
    return with_damping<plant::NoDrive>(description, contact);
  }
  // Straight drives are compositions that few scenes name: damped, be it by nothing.
  const plant::Damped<double> damping{description.numbers.damping};
  switch (scene.drive->waveform) {
    case scene::Waveform::square:
      return with_solver<plant::LevelDrive>(description, contact, damping);
    case scene::Waveform::triangle:
    case scene::Waveform::sawtooth:
      return with_solver<plant::RampDrive>(description, contact, damping);
    case scene::Waveform::cosine:
      break;
  }
  return with_damping<plant::CosineDrive>(description, contact);
}

}  // namespace sonoglide::loop
