#include "host_sim/studies/identify/plant/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::identify::plant {
namespace {

struct Obstacle {
  bool holds;
  const char* key;
  const char* message;
};

/// The scene's echo with what was found in the place of what it had, and nothing that says that it is
/// otherwise.
std::string commissioned(const scene::Scene& nominal, const PlantFit& fit) {
  nlohmann::ordered_json echo = scene_file::to_json(nominal);
  echo.erase("model_error");
  echo.erase("true_values");
  for (const auto& [key, value] : fit.changed) {
    const std::size_t dot = key.find('.');
    echo[key.substr(0, dot)][key.substr(dot + 1)] = value;
  }
  std::string text = "# A scene with the plant that a unit has measured.\n";
  for (const std::string& each : fit.identification.cannot_tell) {
    text += fmt::format("# The readings cannot tell: {}\n", each);
  }
  return text + scene_file::to_toml(echo);
}

/// Fills in the scene and the steps on its plant, or says why there are none.
void add_scene(const configure::Experiment& experiment, PlantStudy& study) {
  std::vector<std::string>& warnings = study.fit.identification.warnings;
  const std::string text = commissioned(experiment.nominal, study.fit);
  try {
    const configure::Experiment found = experiment::read_text(text, "commissioned.toml");
    study.scene = text;
    const auto designed = report::measured_steps(found.plant, *experiment.design);
    const auto commissioned = report::measured_steps(found.plant, *found.design);
    for (std::size_t i = 0; i < std::min(designed.size(), commissioned.size()); ++i) {
      study.steps.push_back({designed[i], commissioned[i]});
    }
  } catch (const scene_file::SceneError& error) {
    warnings.push_back(
        fmt::format("There is no commissioned.toml, because it would be refused: {}: {}",
                    error.key(), error.message()));
  } catch (const loop::ComputationError& error) {
    warnings.push_back(
        fmt::format("The loop on the plant that was found cannot be computed: {}", error.what()));
  }
}

}  // namespace

void require_identifiable(const configure::Experiment& experiment) {
  const scene::Scene& scene = experiment.nominal;
  if (!scene.controller || !experiment.design) {
    throw configure::ConfigurationError(
        "controller", "missing; required: a table [controller], that of the unit");
  }
  const char* const profile = scene.profile_key();
  const std::vector<Obstacle> obstacles = {
      {!scene.sensor.force, "sensor.force",
       "the plant is seen in the readings of a force sensor; required: true"},
      {scene.load.has_value(), "load",
       "the plant is measured at a sliding velocity that is given, and a load's follows from the forces on "
       "it; required: a table [sliding] in its place"},
      {scene.controller->texture.has_value(), "controller.target_texture",
       "the plant is seen in target steps; allowed: target_friction_ratio or "
       "target_friction_force_N"},
      {scene.plant.stiffness_N_per_m <= 0.0, "plant.stiffness_N_per_m",
       "the plant is identified as one with a natural mode; allowed: above 0"},
      {scene.sliding.profile.size() != 1, "sliding.profile",
       "the plant is identified at one velocity; allowed: velocity_m_per_s"},
      {profile != nullptr, profile,
       "the plant is identified as one that does not change; allowed: a constant value"},
      {scene.controller->relearn_every_s.has_value(), "controller.relearn_every_s",
       "a pause of the drive may fall into a step; allowed: a scene without it"}};
  for (const Obstacle& each : obstacles) {
    if (each.holds) {
      throw configure::ConfigurationError(each.key, each.message);
    }
  }
}

std::vector<double> targets(const scene::Scene& scene) {
  const scene::Controller& controller = *scene.controller;
  double strongest = scene.highest_target();
  for (const scene::TargetStep& each : controller.targets()) {
    strongest = std::min(strongest, each.value);
  }
  constexpr double weak = 0.9;
  const double highest = controller.holds_force() ? scene.friction.limit_N() : 1.0;
  const double weakest = std::max(weak * highest, strongest);
  const double middle = 0.5 * (weakest + strongest);
  return {weakest, strongest, weakest, middle, strongest};
}

PlantStudy study(const configure::Experiment& experiment, std::vector<Stretch> stretches,
                 const std::function<void(double)>& progress) {
  PlantStudy study;
  study.name = experiment.nominal.name;
  study.full_scale_N = experiment.design->scales.force_N;
  study.stretches = std::move(stretches);
  study.fit = fit_plant(experiment, study.stretches, progress);
  add_scene(experiment, study);
  return study;
}

}  // namespace sonoglide::identify::plant
