/// What a unit recorded of a stretch of its steps, and what the model of its plant reads there.
#pragma once

#include <Eigen/Core>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::identify::plant {

/// A step of a controller: what it read, and what it answered. Codes as at the seam (hal/board.hpp).
struct RecordedStep {
  std::int32_t friction_force;
  std::int32_t sliding_velocity;
  std::int32_t amplitude;
  std::int32_t other;  ///< bias, or steps of the frequency word; 0 of a drive that has neither
};

/// Steps without a gap. Before the first of them the drive was as in it for long.
struct Stretch {
  std::string name;        ///< for a person
  std::size_t before = 0;  ///< steps before the first answer to another target
  std::vector<RecordedStep> steps;
};

/// Readings of the friction force over the full scale of its sensor, one for each step.
Eigen::VectorXd readings(const Stretch& stretch);

/// What an ideal converter reads where a plant is driven as it was recorded: the loop of the simulation, with
/// the answers played back. Before the first step the drive rises to the first amplitude, so slowly that it
/// hardly excites the natural mode.
///
/// @param plant   slides at a constant velocity, taken from the recorded ones; its noise plays no part
/// @param design  of the controller that was recorded
/// @param steps   from the first one on, > 0, at most all
/// @param free_m_per_s  what the natural mode swings by as the stretch begins, if nothing damps it and friction
///                      does not turn it: its velocity is the real part of free_m_per_s e^jωt
/// @throws loop::ComputationError
Eigen::VectorXd modelled_readings(const scene::Scene& plant, const configure::ControlDesign& design,
                                  const Stretch& stretch, Eigen::Index steps,
                                  std::complex<double> free_m_per_s = {});

}  // namespace sonoglide::identify::plant
