#include "host_sim/loop/steady/requirement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/plant/steady_orbit.hpp"
#include "host_sim/loop/steady/root.hpp"
#include "host_sim/loop/steady/self_excitation.hpp"

namespace sonoglide::steady {
namespace {

/// On the orbit under some forces and speeds: NaN where there is none.
class OrbitRatio {
 public:
  explicit OrbitRatio(const scene::Scene& scene) : scene_(scene) {}

  double operator()(double sliding_m_per_s, double drive_force_N) {
    try {
      const double ratio = orbit_ratio(steady_scene(scene_, sliding_m_per_s, drive_force_N));
      any_ = true;
      return ratio;
    } catch (const loop::ComputationError& error) {
      reason_ = error.what();
      return undefined;
    }
  }

  bool any() const { return any_; }                      ///< of the calls has found one
  const std::string& reason() const { return reason_; }  ///< why the last that has not

 private:
  const scene::Scene& scene_;
  bool any_ = false;
  std::string reason_;
};

/// NaN where the plant settles on none.
double settled_ratio(const scene::Scene& scene, double sliding_m_per_s, double drive_force_N) {
  try {
    return friction_ratio(steady_scene(scene, sliding_m_per_s, drive_force_N));
  } catch (const loop::ComputationError&) {
    return undefined;
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

bool repels(const scene::Scene& scene, double sliding_m_per_s, double drive_force_N) {
  return loop::find_orbit(steady_scene(scene, sliding_m_per_s, drive_force_N), most_steps).repels();
}

/// At resonance friction alone holds against the drive, and the closed form asks for too little.
double first_guess_N(const scene::Scene& scene, double closed_form_force_N) {
  return std::max(closed_form_force_N, 0.1 * scene.friction.limit_N());
}

void solve(const scene::Scene& scene, double closed_form_force_N, Requirement& found) {
  const double sliding_m_per_s = found.sliding_m_per_s;
  OrbitRatio orbit_ratio(scene);
  const auto excess = [&](double force_N) {
    return orbit_ratio(sliding_m_per_s, force_N) - found.ratio;
  };
  found.limit = Obstacle::no_orbit;
  found.closed_form_force_N = closed_form_force_N;
  const FallingBracket bracket(excess, first_guess_N(scene, closed_form_force_N));
  const double force_N = root_in(bracket, excess);
  found.any_orbit = orbit_ratio.any();
  if (!found.any_orbit) {
    found.reason = orbit_ratio.reason();
    return;
  }
  found.closed_form_error =
      settled_ratio(scene, sliding_m_per_s, closed_form_force_N) - found.ratio;
  if (!std::isnan(bracket.minimum())) {
    found.limit = Obstacle::amplitude;
    found.reachable_ratio = settled_ratio(scene, sliding_m_per_s,
                                          std::min(bracket.minimum(), scene.max_drive_force_N()));
    return;
  }
  found.reason = "no force gives the ratio on an orbit of the drive's period";
  try {
    if (!std::isnan(force_N) && repels(scene, sliding_m_per_s, force_N)) {
      found.limit = Obstacle::unstable;
      found.unstable_force_N = force_N;
      found.reason = fmt::format(
          "under the {:.4g} N that give the ratio a small deviation from the steady motion grows",
          force_N);
      return;
    }
    const auto motion = std::isnan(force_N)
                            ? std::nullopt
                            : motion_at(scene, sliding_m_per_s, found.ratio, force_N);
    if (motion) {
      found.motion = *motion;
      found.limit =
          motion->drive_force_N > scene.max_drive_force_N() ? Obstacle::actuator : Obstacle::none;
      found.reason.clear();
    }
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
    case Obstacle::velocity_at_rail:
      return "velocity_at_rail";
    case Obstacle::amplitude:
      return "amplitude";
    case Obstacle::contact_lost:
      return "contact_lost";
    case Obstacle::unstable:
      return "unstable";
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
  const double most_N = scene.max_drive_force_N();
  const RequiredVibration vibration = closed_form_vibration(scene, sliding_m_per_s, ratio);
  const double closed_form_force_N = force_N(scene, vibration.velocity_m_per_s);
  if (vibration.friction_ratio > ratio) {
    const bool opens = scene::is<scene::laws::NormalCoulomb>(scene.friction.law);
    found.limit = opens ? Obstacle::contact_lost : Obstacle::amplitude;
    // Just beside the force at which the contact would touch the surface in one point of the period.
    constexpr double closed = 1.0 - 1e-6;
    found.reachable_ratio = settled_ratio(
        scene, sliding_m_per_s, std::min((opens ? closed : 1.0) * closed_form_force_N, most_N));
    return found;
  }
  solve(scene, closed_form_force_N, found);
  if (found.limit == Obstacle::no_orbit || found.limit == Obstacle::unstable) {
    found.reachable_ratio = undefined;
  }
  if (found.limit == Obstacle::actuator) {
    found.reachable_ratio = settled_ratio(scene, sliding_m_per_s, most_N);
  }
  return found;
}

double fastest_sliding_m_per_s(const scene::Scene& scene, double ratio) {
  if (friction_falls(scene.friction)) {
    return undefined;
  }
  const double most_N = scene.max_drive_force_N();
  // Somewhere below the speed at which the vibration no longer turns the sliding round.
  const double guess_m_per_s =
      ratio * configure::peak_vibration_m_per_s(scene.plant, scene.drive->frequency_Hz, most_N);
  // The faster the slide, the higher the ratio, unless the friction falls.
  OrbitRatio orbit_ratio(scene);
  const auto shortfall = [&](double sliding_m_per_s) {
    return ratio - orbit_ratio(sliding_m_per_s, most_N);
  };
  return root_in(FallingBracket(shortfall, guess_m_per_s), shortfall);
}

}  // namespace sonoglide::steady
