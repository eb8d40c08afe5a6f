#include "host_sim/studies/self_excited/study.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/scene/bound.hpp"
#include "host_sim/scene/friction_laws.hpp"

namespace sonoglide::self_excited {
namespace {

using configure::ConfigurationError;

constexpr std::size_t speed_count = 49;
constexpr std::size_t force_count = 65;

void require_steady_sliding(const scene::Scene& scene) {
  if (scene.load) {
    throw ConfigurationError(
        "load",
        "steady sliding has a velocity that is given; required: a table [sliding] in its place");
  }
  if (const char* key = scene.profile_key()) {
    throw ConfigurationError(key, "steady sliding does not change; allowed: a constant value");
  }
  if (scene::is<scene::laws::None>(scene.friction.law)) {
    throw ConfigurationError("friction.law", "is \"none\"; allowed: a law with friction");
  }
  if (scene.friction.sign_convention == scene::SignConvention::as_printed) {
    throw ConfigurationError(
        "friction.sign_convention",
        "is \"as_printed\", with which any friction feeds the vibration; allowed: \"dissipative\"");
  }
  if (!scene.drive) {
    throw ConfigurationError("drive.frequency_Hz", "missing: windows of a drive are looked for");
  }
  if (scene.drive->waveform != scene::Waveform::cosine) {
    throw ConfigurationError("drive.waveform",
                             "the closed forms are those of a cosine; allowed: \"cosine\"");
  }
}

/// The bound beyond which no steady motion is looked for where a deviation grows, of deviations that die out
/// too. A solver takes more steps for them the lighter the mass: at the bound the study takes 17 times as
/// long as with a slow mode.
void require_resolved(const scene::Scene& scene, double sliding_m_per_s) {
  const double most = std::log(steady::largest_growth);
  const double exponent = steady::undriven_exponent(scene, sliding_m_per_s);
  if (exponent > most) {
    throw ConfigurationError(
        "plant.mass_kg",
        fmt::format(
            "{:g} kg are so light that friction changes a deviation by exp({:.3g}) in a "
            "carrier period, so that no drive is fast against it; allowed: at least {} kg, or "
            "a faster drive.frequency_Hz",
            scene.plant.mass_kg, exponent, scene::at_least(scene.plant.mass_kg * exponent / most)));
  }
}

std::vector<steady::SteadySliding> under_every_force(const scene::Scene& scene,
                                                     double sliding_m_per_s,
                                                     const std::vector<double>& forces_N) {
  std::vector<steady::SteadySliding> row(forces_N.size());
  tbb::parallel_for(std::size_t{0}, row.size(), [&](std::size_t i) {
    row[i] = steady::steady_sliding(scene, sliding_m_per_s, forces_N[i]);
  });
  return row;
}

}  // namespace

Task make_task(const scene::Scene& scene) {
  require_steady_sliding(scene);
  const double speed = std::abs(scene.sliding.profile.front().velocity_m_per_s);
  if (scene.sliding.profile.size() > 1 || !(speed > 0.0)) {
    throw ConfigurationError("sliding.velocity_m_per_s",
                             "steady sliding has one speed; allowed: a number other than 0");
  }
  const double most_N = scene.controller ? scene.max_drive_force_N() : 4.0 * scene.drive_force_N();
  if (!(most_N > 0.0)) {
    throw ConfigurationError("drive.force_amplitude_N",
                             "the map goes to four times this force; allowed: > 0");
  }
  require_resolved(scene, speed);
  return {scene, speed, most_N};
}

Study study(const Task& task, const Progress& progress) {
  Study study{task, steady::friction_falls(task.scene.friction), {}, {}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < speed_count; ++i) {
    const double place = 2.0 * static_cast<double>(i) / (speed_count - 1) - 1.0;
    study.speeds_m_per_s.push_back(task.sliding_m_per_s * std::pow(10.0, place));
  }
  for (std::size_t i = 0; i < force_count; ++i) {
    study.forces_N.push_back(task.most_N * static_cast<double>(i) / (force_count - 1));
  }
  for (const double speed_m_per_s : study.speeds_m_per_s) {
    const auto row = under_every_force(task.scene, speed_m_per_s, study.forces_N);
    study.map.insert(study.map.end(), row.begin(), row.end());
    progress(static_cast<double>(study.map.size()) / (speed_count * force_count));
  }
  study.at_own_speed = under_every_force(task.scene, task.sliding_m_per_s, study.forces_N);
  study.windows = steady::drive_windows(task.scene, task.sliding_m_per_s, task.most_N);
  study.averaged_windows =
      steady::averaged_drive_windows(task.scene, task.sliding_m_per_s, task.most_N);
  return study;
}

}  // namespace sonoglide::self_excited
