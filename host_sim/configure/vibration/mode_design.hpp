/// What the designs of the two loops that damp a natural mode share.
#pragma once

#include <cstdint>

#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/configure/vibration/mode_model.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Real numbers, per unit of ControlScales. The table of a loop has the nominal plant in its middle
/// row; the stiffness of the first row is `stiffness_range` lower, that of the last one as much higher. A
/// mode of 1 is eight times the largest input gain.
struct ModeDesign {
  double stiffness_range = 0.0;    ///< relative
  bool quick = true;               ///< the mode can be quieted, see is_quick()
  std::uint8_t delay_periods = 1;  ///< of drive and sensor

  /// In which the loop follows a small change of its velocity.
  static constexpr double following_periods = 6.0;
  /// Until the natural mode is quiet.
  static constexpr double changing_periods() { return 16.0; }
  static constexpr double building_up_periods() { return 0.0; }
};

/// @throws ConfigurationError  there is no natural mode to damp
void require_mode(const NominalPlant& plant);

/// How far the nominal stiffness may be off, relative: no farther than a third of the way to the
/// carrier is left, nor that the mode's angle would be known to less than 3/4 of a radian.
/// @param stiffness  of a Resonator
double stiffness_range(double stiffness);

/// As quick as it may be without making much of what an observer only believes; slow where the
/// vibration hardly shows the mode. See feedback_gains().
/// @param error  what (w, u − u*) costs
Eigen::RowVector3d feedback_of(const ModeModel& model, const Eigen::Matrix3d& error);

/// The nominal plant in carrier periods. @param velocity_m_per_s  U
Resonator nominal_resonator(const scene::Scene& scene, const NominalPlant& plant,
                            double velocity_m_per_s);

}  // namespace sonoglide::configure
