/// One contact with the damping, the drive and the solver that a scene names: chosen once, before
/// the loop.
#pragma once

#include <memory>

#include "firmware/plant/contact.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "host_sim/loop/plant_description.hpp"
#include "host_sim/loop/plant_port.hpp"
#include "host_sim/loop/solver_list.hpp"

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
  return damping > 0.0 ? with_solver<Drive>(description, contact, plant::Damped<double>{damping})
                       : with_solver<Drive>(description, contact, plant::Undamped<double>{});
}

template <class Law>
std::unique_ptr<PlantPort> compose_plant(const PlantDescription& description,
                                         const plant::Contact<Law>& contact) {
  const scene::Scene& scene = description.scene;
  const bool driven = scene.drive && (scene.drive->force_amplitude_N > 0.0 || scene.controller);
  return driven ? with_damping<plant::CosineDrive>(description, contact)
                : with_damping<plant::NoDrive>(description, contact);
}

}  // namespace sonoglide::loop
