#include "host_sim/runs/lane_scene.hpp"

#include "firmware/plant/taylor/step_share.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::runs {
namespace {

/// Either method that a scene gets that names none: its echo, which names it, then runs as it does, and
/// so do the plants of a study, whichever of the two is the faster for each of them.
bool has_method_of_lanes(const scene::Solver& solver) {
  return !solver.order && (solver.method == scene::method_of<scene::solvers::EventTaylor> ||
                           solver.method == scene::method_of<scene::solvers::EventGauss>);
}

bool suits_lanes(const scene::Scene& scene) {
  return scene.run.start == scene::Start::given && scene.drive && !scene.load &&
         scene.drive->waveform == scene::Waveform::cosine && scene.drive->codes_per_period == 1 &&
         scene.drive->bias_limit_N == 0.0 && scene::is<scene::laws::Dahl>(scene.friction.law) &&
         scene.friction.limit_N() > 0.0 && scene.profile_key() == nullptr &&
         scene.sliding.profile.size() == 1 && !scene.sensor.samples_per_period &&
         has_method_of_lanes(scene.solver);
}

/// The lanes take steps of one share of their tolerance.
bool adds_up_errors(const batch::DahlPlant& plant) {
  return plant::step_share(plant.stiffness, plant::Drift::of_velocity) < 1.0;
}

batch::DahlPlant plant_of(const scene::Scene& scene) {
  const scene::PlantScales scales = configure::plant_scales(scene);
  const configure::PlantNumbers numbers = configure::plant_numbers(scene, scales);
  batch::DahlPlant plant;
  plant.drive_amplitude = scene.controller ? 0.0 : scene.drive_force_N() / scales.force_N;
  plant.damping = numbers.damping;
  plant.stiffness = numbers.stiffness;
  plant.friction_force = numbers.friction_force;
  plant.contact_stiffness = numbers.contact_stiffness;
  plant.sliding_velocity =
      scene.sliding.profile.front().velocity_m_per_s / scales.velocity_m_per_s();
  plant.vibration_sign = configure::vibration_sign(scene.friction.sign_convention);
  plant.initial = configure::initial_state(scene, scales);
  return plant;
}

}  // namespace

std::optional<batch::DahlPlant> lane_plant(const scene::Scene& scene) {
  if (!suits_lanes(scene)) {
    return std::nullopt;
  }
  const batch::DahlPlant plant = plant_of(scene);
  return adds_up_errors(plant) ? std::nullopt : std::optional(plant);
}

}  // namespace sonoglide::runs
