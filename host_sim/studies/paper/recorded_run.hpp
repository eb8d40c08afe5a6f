/// A run of which a stretch is recorded.
#pragma once

#include <vector>

#include "host_sim/loop/recording.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::paper {

/// @param from_s  the recording goes from there to the end of the run, both included
loop::Recording record(const scene::Scene& scene, double from_s, double interval_s);

std::vector<double> displacements_m(const loop::Recording& recording);
std::vector<double> velocities_m_per_s(const loop::Recording& recording);
std::vector<double> friction_forces_N(const loop::Recording& recording);
/// F (Vt + x').
std::vector<double> dissipated_powers_W(const loop::Recording& recording);

}  // namespace sonoglide::paper
