/// The numbers of a loop that feels the plant's natural mode in the friction and damps it.
#pragma once

#include "firmware/control/vibration/sensorless_table.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/configure/vibration/mode_design.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// The base of all velocities of such a loop, per peak vibration velocity at full drive: room for
/// what the model has wrong and for what a mode adds.
inline constexpr double sensorless_room = 4.0;

struct SensorlessDesign : ModeDesign {
  control::SensorlessTable<double> table{};
  double rotation_range =
      0.0;  ///< as stiffness_range, in which the mode turns nearly as the nominal
            ///< one in a period
  double multiple_range =
      0.0;                 ///< likewise, in which it stays away from zero and multiples; or < 0
  bool apart = true;       ///< the mode can be told from the vibration; else the rows are of a gain
  double blur = 0.0;       ///< rms of a reading without its lag, per vibration velocity, at r = 0.6
  double speed = 0.0;      ///< of the fastest sliding
  double mode_unit = 0.0;  ///< velocity of a mode of 1
  double swing = 0.0;      ///< rms of what the model has wrong of a mode of 1, in a period
  double linear = 0.0;     ///< mode per velocity up to which the friction follows it linearly
  double sensor_memory = 0.0;   ///< what its low-pass keeps of the past in a period
  double contact_memory = 0.0;  ///< likewise
  bool backwards = false;       ///< the direction of sliding

  bool tells_mismatch() const { return apart; }
  bool lags() const { return sensor_memory > 0.0 || contact_memory > 0.0; }
};

/// @param velocity_m_per_s  base of all velocities
/// @throws ConfigurationError  a plant without a natural mode, a law whose friction does not show the
///         velocity along the sliding, a sliding in both directions
SensorlessDesign design_sensorless(const scene::Scene& scene, const NominalPlant& plant,
                                   double velocity_m_per_s);

}  // namespace sonoglide::configure
