/// What a design is asked for.
#pragma once

#include <optional>
#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::design {

/// The least friction ratio that is designed for.
inline constexpr double least_ratio = 1e-3;

struct SpeedRange {
  double slowest_m_per_s;  ///< > 0
  double fastest_m_per_s;
};

struct Task {
  scene::Scene scene;          ///< closed loop: plant, contact and drive with its limit
  std::vector<double> ratios;  ///< each once, rising
  SpeedRange speeds;
  bool at_resonance;  ///< where a controller keeps the drive, by its frequency
};

/// The ratios and the speeds that a closed-loop scene gives, unless others are named. The sign of a
/// speed is of no consequence; what the scene slides slower than the controller's speed floor, down
/// to a stop, is left out.
///
/// @param ratios  in (0, 1); empty: the scene's targets
/// @throws configure::ConfigurationError  no controller, no ratio from least_ratio to below 1, or a contact without a steady orbit of the
///         drive's period or without a closed form: sign_convention "as_printed", another waveform
///         than the cosine
Task make_task(const scene::Scene& scene, const std::vector<double>& ratios,
               const std::optional<SpeedRange>& speeds);

/// Slowest sliding at which the scene's controller follows its target: below it the drive is held.
double speed_floor_m_per_s(const scene::Scene& scene);

}  // namespace sonoglide::design
