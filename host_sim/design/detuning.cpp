#include "host_sim/design/detuning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/numeric/turn.hpp"
#include "host_sim/design/root.hpp"
#include "host_sim/design/sensitivity.hpp"
#include "host_sim/loop/computation_error.hpp"

namespace sonoglide::design {
namespace {

constexpr double nearest_to_resonance = 1e-3;
constexpr int points_a_side = 30;

double inertia_N_per_m(const scene::Scene& scene) {
  const double omega = numeric::two_pi * scene.drive->frequency_Hz;
  return scene.plant.mass_kg * omega * omega;
}

/// Distances from resonance by equal factors, on either side of it.
std::vector<double> tunings(double own) {
  const double most_above = std::max(1.0, 1.25 * (own - 1.0));
  std::vector<double> all;
  for (const double most : {smallest_tuning - 1.0, most_above}) {
    const double factor =
        std::pow(nearest_to_resonance / std::abs(most), 1.0 / (points_a_side - 1));
    for (int i = 0; i < points_a_side; ++i) {
      all.push_back(1.0 + most * std::pow(factor, i));
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// One ratio at one speed, on any spring.
class Retuning {
 public:
  Retuning(const scene::Scene& scene, const Requirement& requirement)
      : scene_(scene), requirement_(requirement), own_(tuning(scene)) {}

  /// NaN where none is found.
  double force_N(double tuning) const {
    return require_ratio(retuned(scene_, tuning), requirement_.sliding_m_per_s, requirement_.ratio)
        .motion.drive_force_N;
  }

  /// Of the ratio under a force, by 1 % of the spring.
  double change(double tuning, double force_N) const {
    try {
      return sensitivity(under(tuning, force_N), stiffness()).largest_change();
    } catch (const loop::ComputationError&) {
      return undefined;
    }
  }

  double ratio(double tuning, double force_N) const {
    try {
      return friction_ratio(under(tuning, force_N));
    } catch (const loop::ComputationError&) {
      return undefined;
    }
  }

  DetunedPoint point(double tuning) const {
    const double needed_N = force_N(tuning);
    return {tuning, needed_N, change(tuning, needed_N),
            ratio(tuning, requirement_.motion.drive_force_N)};
  }

  /// Distance from resonance up to which the drive has the force; away from resonance the force is
  /// as this distance.
  /// @param side  -1 below resonance, 1 above
  std::optional<double> reach(double side) const {
    const double most_N = scene_.drive->max_force_amplitude_N;
    const double guess = std::abs(1.0 - own_) * most_N / requirement_.motion.drive_force_N;
    return edge([&](double tuning) { return force_N(tuning) / most_N - 1.0; }, side, guess, true);
  }

  /// Distance from resonance up to which the spring counts for too much.
  std::optional<double> sensitive(double side) const {
    const double allowed = scene_.run.settling_band;
    return edge([&](double tuning) { return change(tuning, force_N(tuning)) / allowed - 1.0; },
                side, 0.5, false);
  }

 private:
  scene::Scene under(double tuning, double force_N) const {
    return steady_scene(retuned(scene_, tuning), requirement_.sliding_m_per_s, force_N);
  }

  /// Where a figure passes zero on one side of resonance; nothing where it does not between the
  /// smallest or largest tuning and its neighbourhood.
  template <class Figure>
  std::optional<double> edge(const Figure& figure, double side, double guess, bool rising) const {
    const double most = side < 0.0 ? 1.0 - smallest_tuning : largest_tuning - 1.0;
    // A tolerance of 1 % must not reach the other side.
    constexpr double least = 0.011;
    const auto within = [&](double distance) {
      return figure(1.0 + side * std::clamp(distance, least, most));
    };
    const double far = within(most);
    const double near = within(least);
    if (!(far * near < 0.0)) {
      return std::nullopt;
    }
    return root_near(within, std::clamp(guess, least, most), rising);
  }

  const scene::Scene& scene_;
  const Requirement& requirement_;
  double own_;
};

std::optional<TuningBand> reachable_band(const Retuning& retuning, double most_N) {
  const auto below = retuning.reach(-1.0);
  const auto above = retuning.reach(1.0);
  const bool below_throughout = !below && retuning.force_N(smallest_tuning) <= most_N;
  const bool above_throughout = !above && retuning.force_N(largest_tuning) <= most_N;
  if (!(below || below_throughout) || !(above || above_throughout)) {
    return std::nullopt;
  }
  return TuningBand{below ? 1.0 - *below : smallest_tuning, above ? 1.0 + *above : largest_tuning};
}

std::optional<TuningBand> sensitive_band(const Retuning& retuning) {
  const auto below = retuning.sensitive(-1.0);
  if (!below) {
    return std::nullopt;
  }
  const auto above = retuning.sensitive(1.0);
  return TuningBand{1.0 - *below, above ? 1.0 + *above : std::numeric_limits<double>::infinity()};
}

}  // namespace

double tuning(const scene::Scene& scene) {
  return scene.plant.stiffness_N_per_m / inertia_N_per_m(scene);
}

scene::Scene retuned(scene::Scene scene, double tuning) {
  scene.plant.stiffness_N_per_m = tuning * inertia_N_per_m(scene);
  return scene;
}

Detuning detune(const scene::Scene& scene, const Requirement& requirement) {
  const Retuning retuning(scene, requirement);
  Detuning detuning{requirement.sliding_m_per_s,
                    requirement.ratio,
                    {},
                    reachable_band(retuning, scene.drive->max_force_amplitude_N),
                    sensitive_band(retuning),
                    undefined};
  if (detuning.sensitive) {
    detuning.force_at_sensitive_low_N = retuning.force_N(detuning.sensitive->low);
  }
  for (const double each : tunings(tuning(scene))) {
    detuning.points.push_back(retuning.point(each));
  }
  return detuning;
}

}  // namespace sonoglide::design
