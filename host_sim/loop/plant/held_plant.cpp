#include "host_sim/loop/plant/held_plant.hpp"

#include <algorithm>
#include <cstddef>

#include "firmware/numeric/turn.hpp"
#include "host_sim/loop/plant/plant_port.hpp"

namespace sonoglide::loop {
namespace {

/// The scene as it is at 0 s, without what a plant is not made of.
scene::Scene held(scene::Scene scene) {
  scene.plant.stiffness_profile.clear();
  scene.friction.coefficient_profile.clear();
  scene.friction.normal_force_profile_N.clear();
  if (scene.drive) {
    scene.drive->frequency_profile.clear();
  }
  scene.controller.reset();
  scene.run.record.clear();
  return scene;
}

}  // namespace

HeldPlant::HeldPlant(const scene::Scene& scene)
    : scene_(held(scene)),
      drive_rate_rad_per_s_(scene.drive ? scene.drive->rate_rad_per_s() : 0.0),
      plant_(make_plant_port(scene_)) {}

void HeldPlant::hold(const Held& wanted, const Carried& from) {
  scene::Friction& friction = scene_.friction;
  if (wanted.contact.coefficient == friction.coefficient &&
      wanted.contact.normal_force_N == friction.normal_force_N &&
      wanted.stiffness_N_per_m == scene_.plant.stiffness_N_per_m &&
      wanted.drive_rate_rad_per_s == drive_rate_rad_per_s_ &&
      wanted.method == scene_.solver.method && wanted.tolerance == scene_.solver.tolerance) {
    return;
  }
  begin(wanted, from);
}

void HeldPlant::begin(const Held& wanted, const Carried& from) {
  spent_ = cost();
  make(wanted);
  put(from);
}

void HeldPlant::make(const Held& wanted) {
  scene_.friction.coefficient = wanted.contact.coefficient;
  scene_.friction.normal_force_N = wanted.contact.normal_force_N;
  scene_.plant.stiffness_N_per_m = wanted.stiffness_N_per_m;
  drive_rate_rad_per_s_ = wanted.drive_rate_rad_per_s;
  if (scene_.drive) {
    scene_.drive->frequency_Hz = drive_rate_rad_per_s_ / numeric::two_pi;
  }
  scene_.solver.method = wanted.method;
  scene_.solver.tolerance = wanted.tolerance;
  plant_ = make_plant_port(scene_);
}

void HeldPlant::copy_state(StateCopy& copy) {
  double frequency_Hz = scene_.drive ? scene_.drive->frequency_Hz : 0.0;
  copy(scene_.friction.coefficient, scene_.friction.normal_force_N, scene_.plant.stiffness_N_per_m,
       frequency_Hz, scene_.solver.method, scene_.solver.tolerance, drive_rate_rad_per_s_, spent_);
  if (copy.is_back()) {
    if (scene_.drive) {
      scene_.drive->frequency_Hz = frequency_Hz;
    }
    plant_ = make_plant_port(scene_);
  }
  plant_->copy_state(copy);
}

HeldPlant::Carried HeldPlant::carried() const {
  Carried now{plant_->state(), plant_->memory()};
  const std::vector<double> limits_N = plant_->memory_limits_N();
  for (std::size_t i = 0; i < limits_N.size(); ++i) {
    now.forces_N[i] *= limits_N[i];
  }
  return now;
}

void HeldPlant::put(const Carried& from) {
  PlantState state = from.state;
  if (scene::is_bounded(scene_.friction.law)) {
    const double limit_N = scene_.friction.limit_N();
    state.friction_force_N = std::clamp(state.friction_force_N, -limit_N, limit_N);
  }
  // The limits of some depend on the displacement, which therefore goes first.
  std::vector<double> parts(plant_->memory().size(), 0.0);
  plant_->begin_at(state, parts);
  const std::vector<double> limits_N = plant_->memory_limits_N();
  for (std::size_t i = 0; i < std::min(parts.size(), from.forces_N.size()); ++i) {
    parts[i] = limits_N[i] > 0.0 ? std::clamp(from.forces_N[i] / limits_N[i], -1.0, 1.0) : 0.0;
  }
  plant_->begin_at(state, parts);
}

plant::Cost HeldPlant::cost() const {
  const plant::Cost now = plant_->cost();
  return {spent_.steps + now.steps, spent_.events + now.events};
}

void HeldPlant::set_cost(const plant::Cost& cost) {
  const plant::Cost now = plant_->cost();
  spent_ = {cost.steps - now.steps, cost.events - now.events};
}

}  // namespace sonoglide::loop
