#include "host_sim/report/self_excitation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "host_sim/loop/plant/sliding_profile.hpp"
#include "host_sim/loop/steady/requirement.hpp"
#include "host_sim/loop/steady/self_excitation.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/report/step_metrics.hpp"

namespace sonoglide::report {
namespace {

double speed_m_per_s(const scene::Scene& scene, double time_s) {
  return std::abs(loop::SlidingProfile(scene.sliding).velocity_m_per_s(time_s));
}

}  // namespace

bool may_excite_itself(const scene::Scene& scene) {
  return scene.drive && !scene.load && scene.drive->waveform == scene::Waveform::cosine &&
         scene.profile_key() == nullptr && steady::friction_falls(scene.friction);
}

bool excites_itself(const scene::Scene& scene, double time_s, double drive_force_N) {
  const double sliding_m_per_s = speed_m_per_s(scene, time_s);
  return sliding_m_per_s > 0.0 && std::isfinite(drive_force_N) &&
         steady::steady_sliding(scene, sliding_m_per_s, std::abs(drive_force_N)).fate() ==
             steady::Fate::grows;
}

std::vector<std::string> self_excitation_notes(const scene::Scene& scene) {
  if (!scene.controller || !may_excite_itself(scene)) {
    return {};
  }
  std::vector<std::string> notes;
  std::set<std::pair<double, double>> told;
  const TargetUnit unit = target_unit(scene);
  for (const scene::TargetStep& step : scene.controller->targets()) {
    const double sliding_m_per_s = speed_m_per_s(scene, step.time_s);
    const double ratio = unit.is_force()
                             ? step.value / scene::undriven_friction_N(
                                                scene.friction.law, scene.friction, sliding_m_per_s)
                             : step.value;
    if (!(sliding_m_per_s > 0.0) || ratio > 1.0 || !told.emplace(ratio, sliding_m_per_s).second) {
      continue;
    }
    const steady::Requirement needed = steady::require_ratio(scene, sliding_m_per_s, ratio);
    const bool undriven =
        needed.limit == steady::Obstacle::undriven && excites_itself(scene, step.time_s, 0.0);
    if (needed.limit == steady::Obstacle::unstable || undriven) {
      notes.push_back(fmt::format(
          "The target {:.4g}{} at {:.4g} m/s takes a drive of {:.4g} N, under which falling friction "
          "feeds an oscillation. sonoglide stability {}.toml --self-excited tells the windows of the "
          "drive that quench it.",
          step.value, unit.is_force() ? " N" : "", sliding_m_per_s,
          undriven ? 0.0 : needed.unstable_force_N, scene.name));
    }
  }
  return notes;
}

std::string missed_windows_text(double most_N) {
  return fmt::format(
      "A window narrower than {:g} % of its force and than {} may be missed, unless averaging has it "
      "too.",
      100.0 * steady::narrowest_part, output::quantity(most_N / steady::scan_steps, "N"));
}

}  // namespace sonoglide::report
