/// What resonance gives and what it costs: the same contact on another spring.
#pragma once

#include <optional>
#include <vector>

#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/design/requirement.hpp"

namespace sonoglide::design {

/// Of the tuning Ks/(m w²): 1 at resonance, the mass alone counts towards 0, the spring alone far
/// above 1.
double tuning(const scene::Scene& scene);

/// The scene on the spring that gives it a tuning.
scene::Scene retuned(scene::Scene scene, double tuning);

/// NaN where no steady vibration is found.
struct DetunedPoint {
  double tuning;
  double drive_force_N;        ///< that the ratio takes
  double change_by_stiffness;  ///< of the ratio, largest by 1 % more or less of Ks, under it
  double ratio_at_same_force;  ///< under the force that it takes at the scene's own tuning
};

struct TuningBand {
  double low;
  double high;
};

/// Of one ratio at one sliding speed.
struct Detuning {
  double sliding_m_per_s = 0.0;
  double ratio = 0.0;
  std::vector<DetunedPoint> points;  ///< tuning rises
  /// Where the drive has the force; smallest_tuning or largest_tuning where that goes on beyond.
  std::optional<TuningBand> reachable;
  /// About resonance: outside it 1 % of Ks changes the ratio by no more than the scene's settling
  /// band; largest_tuning where springs above resonance all are too sensitive.
  std::optional<TuningBand> sensitive;
  double change_by_stiffness = undefined;  ///< as a point's, at the scene's own tuning
  double force_at_sensitive_low_N =
      undefined;  ///< the least force below resonance outside that band
};

inline constexpr double smallest_tuning = 0.01;  ///< without a spring mean friction has no hold
inline constexpr double largest_tuning = 50.0;   ///< no square number: harmonics meet no resonance

/// @param requirement  of the scene at its own tuning, with a motion
Detuning detune(const scene::Scene& scene, const Requirement& requirement);

}  // namespace sonoglide::design
