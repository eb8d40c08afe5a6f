/// The runs that the figures show: recordings, and ratios over the sliding velocity.
#pragma once

#include <vector>

#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::paper {

/// @param from_s  the recording goes from there to the end of the run, both included
loop::Recording record(const scene::Scene& scene, double from_s, double interval_s);

std::vector<double> displacements_m(const loop::Recording& recording);
std::vector<double> velocities_m_per_s(const loop::Recording& recording);
std::vector<double> friction_forces_N(const loop::Recording& recording);
/// F (Vt + x').
std::vector<double> dissipated_powers_W(const loop::Recording& recording);

/// One value for each sliding velocity; NaN where the solver gives up or no steady orbit exists.
struct SimulatedRatios {
  std::vector<double> friction_from_rest;  ///< mean over the scene's run
  std::vector<double> dissipation_from_rest;
  std::vector<double> friction_steady;  ///< mean over a carrier period of the steady orbit
  std::vector<double> dissipation_steady;
};

/// 0.05 to 1.2.
const std::vector<double>& velocity_ratios();

/// Index of a velocity ratio in that list, which has it.
std::size_t index_of(double velocity_ratio);

/// On every core.
SimulatedRatios ratio_curve(const scene::Scene& scene, const std::vector<double>& sliding_m_per_s);

/// The sliding velocities that belong to velocity_ratios() in this scene.
std::vector<double> sliding_velocities_m_per_s(const scene::Scene& scene);

}  // namespace sonoglide::paper
