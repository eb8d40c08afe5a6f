#include "host_sim/studies/design/study.hpp"

#include <cmath>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/steady/requirement.hpp"

namespace sonoglide::design {
namespace {

double ratio_or_none(const scene::Scene& scene, const SceneParameter& parameter, double factor) {
  try {
    return ratio_with(scene, parameter, factor);
  } catch (const loop::ComputationError&) {
    return steady::undefined;
  }
}

/// d rho/d ln p by central differences of fourth order: beside a resonance the ratio bends within
/// a hundredth of a parameter.
double derivative(const scene::Scene& scene, const SceneParameter& parameter) {
  constexpr double h = 2e-4;
  const auto rise = [&](double part) {
    return ratio_or_none(scene, parameter, 1.0 + part) -
           ratio_or_none(scene, parameter, 1.0 - part);
  };
  return (8.0 * rise(h) - rise(2.0 * h)) / (12.0 * h);
}

Sensitivity sensitivity(const scene::Scene& scene, const SceneParameter& parameter, double ratio) {
  return {parameter, derivative(scene, parameter) / ratio,
          ratio_or_none(scene, parameter, 1.0 + parameter_change) - ratio,
          ratio_or_none(scene, parameter, 1.0 - parameter_change) - ratio};
}

}  // namespace

double ratio_with(scene::Scene steady_scene, const SceneParameter& parameter, double factor) {
  parameter.in(steady_scene) *= factor;
  steady_scene.run.duration_s = 1.0 / steady_scene.drive->frequency_Hz;
  return steady::friction_ratio(steady_scene);
}

double Sensitivity::largest_change() const {
  const double more = std::abs(change_by_more);
  const double less = std::abs(change_by_less);
  return more > less || std::isnan(more) ? more : less;
}

SceneParameter stiffness() {
  return {"plant.stiffness_N_per_m", "Ks",
          [](scene::Scene& s) -> double& { return s.plant.stiffness_N_per_m; }};
}

std::vector<SceneParameter> parameters_of(const scene::Scene& steady_scene) {
  std::vector<SceneParameter> all = {
      {"plant.mass_kg", "m", [](scene::Scene& s) -> double& { return s.plant.mass_kg; }},
      stiffness()};
  if (steady_scene.plant.damping_N_s_per_m > 0.0) {
    all.push_back({"plant.damping_N_s_per_m", "c",
                   [](scene::Scene& s) -> double& { return s.plant.damping_N_s_per_m; }});
  }
  all.push_back({"friction.coefficient", "mu",
                 [](scene::Scene& s) -> double& { return s.friction.coefficient; }});
  all.push_back({"friction.normal_force_N", "N",
                 [](scene::Scene& s) -> double& { return s.friction.normal_force_N; }});
  if (scene::is_elastic(steady_scene.friction.law)) {
    all.push_back({"friction.contact_stiffness_N_per_m", "Kt", [](scene::Scene& s) -> double& {
                     return s.friction.contact_stiffness_N_per_m;
                   }});
  }
  all.push_back({"drive.frequency_Hz", "f",
                 [](scene::Scene& s) -> double& { return s.drive->frequency_Hz; }});
  all.push_back({"drive.force_amplitude_N", "Fe",
                 [](scene::Scene& s) -> double& { return s.drive->force_amplitude_N; }});
  all.push_back({"sliding.velocity_m_per_s", "Vt", [](scene::Scene& s) -> double& {
                   return s.sliding.profile.front().velocity_m_per_s;
                 }});
  return all;
}

std::vector<Sensitivity> sensitivities(const scene::Scene& steady_scene) {
  const double ratio = steady::friction_ratio(steady_scene);
  std::vector<Sensitivity> all;
  for (const SceneParameter& parameter : parameters_of(steady_scene)) {
    all.push_back(sensitivity(steady_scene, parameter, ratio));
  }
  return all;
}

}  // namespace sonoglide::design
