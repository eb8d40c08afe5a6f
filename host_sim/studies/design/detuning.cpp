#include "host_sim/studies/design/study.hpp"

#include <algorithm>
#include <cmath>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/steady/root.hpp"

namespace sonoglide::design {
namespace {

constexpr int points_a_side = 30;
/// A tolerance of 1 % must not reach the other side of resonance.
constexpr double nearest = 0.011;

double inertia_N_per_m(const scene::Scene& scene) {
  const double omega = scene.drive->rate_rad_per_s();
  return scene.plant.mass_kg * omega * omega;
}

/// Distances from resonance by the squares of equal steps, on either side of it.
std::vector<double> tunings(double own) {
  const double most_above = std::max(1.0, 1.25 * (own - 1.0));
  std::vector<double> all;
  all.reserve(2 * points_a_side);
  for (const double most : {smallest_tuning - 1.0, most_above}) {
    for (int i = 1; i <= points_a_side; ++i) {
      const double part = static_cast<double>(i) / points_a_side;
      all.push_back(1.0 + most * part * part);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// One ratio at one speed, on any spring.
class Retuning {
 public:
  Retuning(const scene::Scene& scene, const steady::Requirement& requirement)
      : scene_(scene), requirement_(requirement) {}

  /// NaN where none is found.
  double force_N(double tuning) const {
    return steady::require_ratio(retuned(scene_, tuning), requirement_.sliding_m_per_s,
                                 requirement_.ratio)
        .motion.drive_force_N;
  }

  /// Of the ratio under the force that gives it, by 1 % of the spring.
  double change(double tuning, double force_N) const {
    try {
      const scene::Scene steady = under(tuning, force_N);
      const auto by = [&](double part) {
        return std::abs(ratio_with(steady, stiffness(), 1.0 + part) - requirement_.ratio);
      };
      return std::max(by(parameter_change), by(-parameter_change));
    } catch (const loop::ComputationError&) {
      return steady::undefined;
    }
  }

  double ratio(double tuning, double force_N) const {
    try {
      return steady::friction_ratio(under(tuning, force_N));
    } catch (const loop::ComputationError&) {
      return steady::undefined;
    }
  }

  DetunedPoint point(double tuning) const {
    const double needed_N = force_N(tuning);
    return {tuning, needed_N, change(tuning, needed_N),
            ratio(tuning, requirement_.motion.drive_force_N)};
  }

  /// Farthest from resonance where the drive has the force.
  /// @param side  -1 below resonance, 1 above
  std::optional<double> reach(double side) const {
    const double most_N = scene_.max_drive_force_N();
    return outermost(side, [&](double tuning) { return 1.0 - force_N(tuning) / most_N; });
  }

  /// Farthest from resonance where the spring counts for too much.
  std::optional<double> sensitive(double side) const {
    const double allowed = scene_.run.settling_band;
    return outermost(
        side, [&](double tuning) { return change(tuning, force_N(tuning)) / allowed - 1.0; });
  }

 private:
  scene::Scene under(double tuning, double force_N) const {
    return steady::steady_scene(retuned(scene_, tuning), requirement_.sliding_m_per_s, force_N);
  }

  /// The tuning farthest from resonance at which a figure is positive, looked for at distances
  /// that shrink by equal factors: the far end where it is so there, nothing where it nowhere is.
  template <class Figure>
  static std::optional<double> outermost(double side, const Figure& figure) {
    constexpr int steps = 24;
    const double far_end = side < 0.0 ? smallest_tuning : largest_tuning;
    const double factor = std::pow(nearest / std::abs(far_end - 1.0), 1.0 / steps);
    double last = far_end;
    double last_figure = steady::undefined;
    for (int i = 0; i <= steps; ++i) {
      const double tuning = i == 0 ? far_end : 1.0 + (far_end - 1.0) * std::pow(factor, i);
      const double here = figure(tuning);
      if (here > 0.0) {
        const double edge = last_figure < 0.0 ? steady::root_between(figure, std::min(tuning, last),
                                                                     std::max(tuning, last))
                                              : steady::undefined;
        return std::isnan(edge) ? tuning : edge;
      }
      last = tuning;
      last_figure = here;
    }
    return std::nullopt;
  }

  const scene::Scene& scene_;
  const steady::Requirement& requirement_;
};

std::optional<TuningBand> reachable_band(const Retuning& retuning) {
  const auto below = retuning.reach(-1.0);
  const auto above = retuning.reach(1.0);
  return below && above ? std::optional(TuningBand{*below, *above}) : std::nullopt;
}

std::optional<TuningBand> sensitive_band(const Retuning& retuning) {
  const auto below = retuning.sensitive(-1.0);
  const auto above = retuning.sensitive(1.0);
  return below || above ? std::optional(TuningBand{below.value_or(1.0), above.value_or(1.0)})
                        : std::nullopt;
}

}  // namespace

double tuning(const scene::Scene& scene) {
  return scene.plant.stiffness_N_per_m / inertia_N_per_m(scene);
}

scene::Scene retuned(scene::Scene scene, double tuning) {
  scene.plant.stiffness_N_per_m = tuning * inertia_N_per_m(scene);
  return scene;
}

Detuning detune(const scene::Scene& scene, const steady::Requirement& requirement) {
  const Retuning retuning(scene, requirement);
  Detuning detuning{requirement.sliding_m_per_s,
                    requirement.ratio,
                    {},
                    reachable_band(retuning),
                    sensitive_band(retuning),
                    retuning.change(tuning(scene), requirement.motion.drive_force_N),
                    steady::undefined};
  if (detuning.sensitive) {
    detuning.force_at_sensitive_low_N = retuning.force_N(detuning.sensitive->low);
  }
  for (const double each : tunings(tuning(scene))) {
    detuning.points.push_back(retuning.point(each));
  }
  return detuning;
}

}  // namespace sonoglide::design
