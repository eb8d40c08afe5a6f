/// Made-up closed-loop runs of known course.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// One carrier period lasts 1 ms.
inline constexpr double made_up_period_s = 1e-3;

/// A closed-loop scene of 1 ms carrier periods.
inline scene::Scene made_up_scene(std::vector<scene::TargetStep> targets, double duration_s,
                                  double band = 0.01) {
  scene::Scene scene;
  scene.drive.emplace();
  scene.drive->frequency_Hz = 1.0 / made_up_period_s;
  scene.run.duration_s = duration_s;
  scene.run.settling_band = band;
  scene.controller.emplace();
  scene.controller->target_friction_ratio = std::move(targets);
  return scene;
}

/// The carrier periods of a run whose friction ratio in period k is ratio(k); sliding at a constant
/// 1 m/s, the target of each period that of the scene, drive amplitude 100 N, no limit.
inline std::vector<loop::Period> made_up_run(const scene::Scene& scene,
                                             const std::function<double(int)>& ratio) {
  std::vector<loop::Period> periods;
  const double end_s = scene.run.duration_s;
  for (int k = 0; k * made_up_period_s < end_s - 1e-9; ++k) {
    loop::Period period{};
    period.begin_s = k * made_up_period_s;
    period.end_s = std::min((k + 1) * made_up_period_s, end_s);  // the last one may be cut short
    period.whole = period.end_s - period.begin_s > 0.999 * made_up_period_s;
    period.friction_ratio = ratio(k);
    period.begin_velocity_m_per_s = 1.0;
    period.end_velocity_m_per_s = 1.0;
    period.drive_amplitude_N = 100.0;
    for (const scene::TargetStep& step : scene.controller->target_friction_ratio) {
      if (step.time_s <= period.begin_s + 1e-9) {
        period.target = step.value;
        period.target_ratio = step.value;
      }
    }
    period.state = control::State::running;
    periods.push_back(period);
  }
  return periods;
}

}  // namespace sonoglide::report
