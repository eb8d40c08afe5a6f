#include "host_sim/studies/design/requirement.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/failure.hpp"
#include "host_sim/studies/design/closed_form.hpp"

namespace sonoglide::design {
namespace {

/// 0 where there is no steady vibration: a drive that puts in more than friction and damping can
/// take lowers the ratio without end.
double ratio_or_zero(const scene::Scene& scene, double sliding_m_per_s, double drive_force_N) {
  try {
    return friction_ratio(steady_scene(scene, sliding_m_per_s, drive_force_N));
  } catch (const loop::ComputationError&) {
    return 0.0;
  }
}

/// The drive's force gives the ratio where the root-finder says so, and not a jump over it.
std::optional<SteadyMotion> motion_at(const scene::Scene& scene, double sliding_m_per_s,
                                      double ratio, double drive_force_N) {
  constexpr double largest_error = 1e-6;
  const SteadyMotion motion = steady_motion(steady_scene(scene, sliding_m_per_s, drive_force_N));
  return std::abs(motion.friction_ratio - ratio) <= largest_error ? std::optional(motion)
                                                                  : std::nullopt;
}

/// At resonance friction alone holds against the drive, and the closed form asks for too little.
double first_guess_N(const scene::Scene& scene, double closed_form_force_N) {
  return std::max(closed_form_force_N, 0.1 * scene.friction.limit_N());
}

/// Where the closed form's force has no steady vibration, no other is tried.
void solve(const scene::Scene& scene, double closed_form_force_N, Requirement& found) {
  const double sliding_m_per_s = found.sliding_m_per_s;
  const auto excess = [&](double force_N) {
    return ratio_or_zero(scene, sliding_m_per_s, force_N) - found.ratio;
  };
  found.limit = Obstacle::no_orbit;
  found.closed_form_force_N = closed_form_force_N;
  try {
    found.closed_form_error =
        friction_ratio(steady_scene(scene, sliding_m_per_s, closed_form_force_N)) - found.ratio;
    const auto force_N = root_near(excess, first_guess_N(scene, closed_form_force_N), false);
    const auto motion =
        force_N ? motion_at(scene, sliding_m_per_s, found.ratio, *force_N) : std::nullopt;
    if (!motion) {
      found.reason = "no force gives the ratio on a steady orbit of the drive's period";
      return;
    }
    found.motion = *motion;
    found.limit = motion->drive_force_N > scene.drive->max_force_amplitude_N ? Obstacle::actuator
                                                                             : Obstacle::none;
  } catch (const loop::ComputationError& error) {
    found.reason = error.what();
  }
}

}  // namespace

const char* name(Obstacle limit) {
  switch (limit) {
    case Obstacle::none:
      return "none";
    case Obstacle::undriven:
      return "undriven";
    case Obstacle::actuator:
      return "actuator";
    case Obstacle::amplitude:
      return "amplitude";
    case Obstacle::no_orbit:
      break;
  }
  return "no_orbit";
}

Requirement require_ratio(const scene::Scene& scene, double sliding_m_per_s, double ratio) {
  Requirement found;
  found.sliding_m_per_s = sliding_m_per_s;
  found.ratio = ratio;
  found.reachable_ratio = ratio;
  if (ratio >= 1.0) {
    found.limit = Obstacle::undriven;
    return found;
  }
  const double most_N = scene.drive->max_force_amplitude_N;
  const RequiredVibration vibration = closed_form_vibration(scene, sliding_m_per_s, ratio);
  const double closed_form_force_N = force_N(scene, vibration.velocity_m_per_s);
  if (vibration.friction_ratio > ratio) {
    found.limit = Obstacle::amplitude;
    found.reachable_ratio =
        ratio_or_zero(scene, sliding_m_per_s, std::min(closed_form_force_N, most_N));
    return found;
  }
  solve(scene, closed_form_force_N, found);
  if (found.limit == Obstacle::no_orbit) {
    found.reachable_ratio = undefined;
  }
  if (found.limit == Obstacle::actuator) {
    found.reachable_ratio = ratio_or_zero(scene, sliding_m_per_s, most_N);
  }
  return found;
}

double fastest_sliding_m_per_s(const scene::Scene& scene, double ratio) {
  const double most_N = scene.drive->max_force_amplitude_N;
  // Somewhere below the speed at which the vibration no longer turns the sliding round.
  const double guess_m_per_s =
      ratio * configure::peak_vibration_m_per_s(scene.plant, scene.drive->frequency_Hz, most_N);
  const auto excess = [&](double sliding_m_per_s) {
    return ratio_or_zero(scene, sliding_m_per_s, most_N) - ratio;
  };
  return root_near(excess, guess_m_per_s, true).value_or(undefined);
}

}  // namespace sonoglide::design
