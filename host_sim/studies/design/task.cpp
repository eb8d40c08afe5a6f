#include "host_sim/studies/design/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/bound.hpp"

namespace sonoglide::design {
namespace {

void require_steady_vibration(const scene::Scene& scene) {
  if (!scene.controller) {
    throw configure::ConfigurationError(
        "controller",
        "missing: a design takes its ratios and the drive's limit from a closed "
        "loop; required: a table [controller], and drive.max_force_amplitude_N or, with a "
        "[transducer], drive.max_voltage_amplitude_V");
  }
  if (scene.controller->texture) {
    throw configure::ConfigurationError(
        "controller.target_texture",
        "a design is for targets that stand still; allowed: target_friction_ratio with the lowest and "
        "the highest ratio of the texture, or target_friction_force_N");
  }
  if (scene.load) {
    throw configure::ConfigurationError(
        "load",
        "a design is for a sliding velocity that is given; required: a table [sliding] in "
        "its place");
  }
  if (const char* key = scene.profile_key()) {
    throw configure::ConfigurationError(key,
                                        "a design is for a plant that does not change; allowed: a "
                                        "constant value in place of a profile");
  }
  if (scene.friction.sign_convention == scene::SignConvention::as_printed) {
    throw configure::ConfigurationError(
        "friction.sign_convention",
        "is \"as_printed\", with which friction feeds the vibration and no orbit is steady; "
        "allowed: \"dissipative\"");
  }
  if (scene.drive->waveform != scene::Waveform::cosine) {
    throw configure::ConfigurationError(
        "drive.waveform", "the closed forms are those of a cosine; allowed: \"cosine\"");
  }
}

/// With any other alone there is no curve of force over speed.
void require_some_ratio(const scene::Scene& scene, const std::vector<double>& ratios) {
  const bool some =
      std::any_of(ratios.begin(), ratios.end(), [](double ratio) { return is_allowed(ratio); });
  if (some) {
    return;
  }
  const double friction_N = configure::nominal_plant(scene).friction_N;
  throw configure::ConfigurationError(
      fmt::format("controller.{}", scene.controller->target_key()),
      fmt::format("no target to design for; allowed: at least one of {}",
                  scene.controller->holds_force()
                      ? fmt::format("{} N to below {} N", scene::at_least(least_ratio * friction_N),
                                    scene::at_most(friction_N))
                      : allowed_ratios()));
}

SpeedRange speeds_of(const scene::Scene& scene, double floor_m_per_s) {
  const double fastest = scene.sliding.fastest_m_per_s();
  double slowest = fastest;
  double last = scene.sliding.profile.front().velocity_m_per_s;
  for (const scene::SpeedPoint& point : scene.sliding.profile) {
    const bool reverses = last * point.velocity_m_per_s < 0.0;
    slowest = reverses ? 0.0 : std::min(slowest, std::abs(point.velocity_m_per_s));
    last = point.velocity_m_per_s;
  }
  // The floor of a scene that gives none is at most half of its fastest speed.
  return {std::min(std::max(slowest, floor_m_per_s), fastest), fastest};
}

constexpr double slowest_m_per_s = 1e-9;
constexpr double fastest_m_per_s = 1e6;

}  // namespace

bool is_allowed(double ratio) {
  return ratio >= least_ratio && ratio < 1.0;
}

std::string allowed_ratios() {
  return fmt::format("{} to below 1", least_ratio);
}

bool is_allowed(const SpeedRange& speeds) {
  return speeds.slowest_m_per_s >= slowest_m_per_s &&
         speeds.fastest_m_per_s >= speeds.slowest_m_per_s &&
         speeds.fastest_m_per_s <= fastest_m_per_s;
}

std::string allowed_speeds() {
  return fmt::format("FROM:TO in m/s, {:g} <= FROM <= TO <= {:g}", slowest_m_per_s,
                     fastest_m_per_s);
}

Task make_task(const configure::Experiment& experiment, const std::vector<double>& ratios,
               const std::optional<SpeedRange>& speeds) {
  const scene::Scene& scene = experiment.plant;
  require_steady_vibration(scene);
  const configure::ControlDesign& control = *experiment.design;
  const double floor_m_per_s = control.speed_floor_m_per_s();
  Task task{
      scene,
      experiment.nominal,
      floor_m_per_s,
      control.scales.velocity_m_per_s,
      ratios.empty() ? configure::nominal_plant(scene).target_ratios(*scene.controller) : ratios,
      speeds ? *speeds : speeds_of(scene, floor_m_per_s),
      scene.resonant()};
  if (task.at_resonance) {
    // The loop there is another one, of another carrier.
    task.scene.drive->frequency_Hz = scene.plant.natural_Hz();
    task.stated.drive->frequency_Hz = task.scene.drive->frequency_Hz;
    const configure::ControlDesign there = configure::design_control(task.stated);
    task.speed_floor_m_per_s = there.speed_floor_m_per_s();
    task.full_scale_m_per_s = there.scales.velocity_m_per_s;
  }
  if (!(task.speeds.slowest_m_per_s > 0.0)) {
    throw configure::ConfigurationError(
        "sliding.velocity_m_per_s",
        "nothing slides, and there is no friction ratio; allowed: a speed other than 0");
  }
  require_some_ratio(scene, task.ratios);
  std::sort(task.ratios.begin(), task.ratios.end());
  task.ratios.erase(std::unique(task.ratios.begin(), task.ratios.end()), task.ratios.end());
  return task;
}

}  // namespace sonoglide::design
