#include "host_sim/runs/lane_scene.hpp"

#include "firmware/plant/taylor/step_share.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/cores/fastest_method.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::runs {
namespace {

/// The lanes have event_taylor's method, and serve where a scene that names none gets another one: its
/// echo, which names that, runs as it does.
bool has_method_of_lanes(const scene::Scene& scene) {
  const bool taylor = scene.solver.method == scene::method_of<scene::solvers::EventTaylor>;
  return !scene.solver.order && (taylor || scene.solver.method == scene::fastest_method(scene));
}

bool suits_lanes(const scene::Scene& scene) {
  return scene.run.start == scene::Start::given && scene.drive &&
         scene.drive->waveform == scene::Waveform::cosine && scene.drive->codes_per_period == 1 &&
         scene.drive->bias_limit_N == 0.0 && scene::is<scene::laws::Dahl>(scene.friction.law) &&
         scene.friction.limit_N() > 0.0 && scene.profile_key() == nullptr &&
         scene.sliding.profile.size() == 1 && has_method_of_lanes(scene);
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
