/// A design: what the drive must do, how far it gets, and what it hangs on.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host_sim/studies/design/detuning.hpp"
#include "host_sim/studies/design/electrical.hpp"
#include "host_sim/studies/design/requirement.hpp"
#include "host_sim/studies/design/sensitivity.hpp"
#include "host_sim/studies/design/task.hpp"

namespace sonoglide::design {

using Progress = std::function<void(double fraction)>;

/// A ratio at an end of the task's speeds.
struct DesignPoint {
  Requirement requirement;
  std::vector<Sensitivity> sensitivities;  ///< empty without a motion
};

/// One friction ratio over all speeds.
struct RatioRequirements {
  double ratio;
  std::vector<Requirement> requirements;  ///< by rising speed: study().speeds_m_per_s
  double fastest_m_per_s;                 ///< at which the whole drive holds the ratio; may be NaN
};

struct DesignStudy {
  Task task;
  double tuning;  ///< Ks/(m w²)
  std::vector<RatioRequirements> curves;
  std::vector<DesignPoint> points;  ///< slowest speed first, ratios rising; one speed is once
  std::vector<Detuning> detunings;  ///< each ratio at the fastest speed, where it has a motion
  /// With a transducer: of the point that takes the most power from the amplifier.
  std::optional<ResonantSpring> resonant_spring;
};

/// The point that takes the most apparent power from the amplifier; null without a transducer, and
/// without a motion.
const Requirement* most_electrical(const DesignStudy& study);

/// The design points that have a motion.
std::vector<DesignPoint> moving_points(const DesignStudy& study);

/// On every core. Of a single speed the curves go from a tenth to ten times it.
/// @throws loop::ComputationError  under no force that was tried there is an orbit
DesignStudy study(const Task& task, const Progress& progress);

}  // namespace sonoglide::design
