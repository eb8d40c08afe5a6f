/// The numbers of a loop that observes the plant's natural mode and damps it.
#pragma once

#include <cstdint>

#include "firmware/control/vibration/mode_table.hpp"
#include "host_sim/configure/mode_model.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Real numbers, per unit of ControlScales.
struct DampedDesign {
  /// Of the nominal plant in the middle row; the stiffness of the first row is `stiffness_range`
  /// lower, that of the last one as much higher. A mode of 1 is eight times the largest input gain.
  control::ModeTable<double> table{};
  double stiffness_range = 0.0;  ///< relative
  bool quick = true;             ///< the mode can be quieted, see is_quick()
  double noise = 0.0;            ///< of a vibration sample, converter included, rms
  double audible = 0.0;
  double quiet = 0.0;  ///< mode and change of the amplitude up to which no slope is audible
  double settled = 0.0;
  double missing = 0.0;
  std::uint8_t delay_periods = 1;

  /// In which the loop follows a small change of its velocity.
  static constexpr double following_periods = 6.0;
  /// Until the natural mode is quiet.
  static constexpr double changing_periods() { return 16.0; }
  static constexpr double building_up_periods() { return 0.0; }
  static constexpr bool tells_mismatch() { return true; }
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

/// The range of the vibration sensor.
/// @throws ConfigurationError  full drive vibrates at less than 1/64 of it, or at more than half
double damped_full_scale_m_per_s(const scene::Scene& scene, const NominalPlant& plant);

/// @param full_scale_m_per_s  of the vibration sensor
/// @throws ConfigurationError  a plant without a natural mode
DampedDesign design_damping(const scene::Scene& scene, const NominalPlant& plant,
                            double full_scale_m_per_s);

}  // namespace sonoglide::configure
