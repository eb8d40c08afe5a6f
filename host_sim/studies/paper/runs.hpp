/// The runs that the figures show: recordings, and ratios over the sliding velocity.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::paper {

// The paper's Tables 1 and 2 as scenes, and their variations. Table 2 adds the solver.

/// 384 N, velocity ratio 0.5, from rest, 100 carrier periods: the file table_1.toml of the output.
std::string table_1_text();

/// The same by the paper's solver: table_2.toml.
std::string table_2_text();

/// Table 1 with another contact, begun at the displacement of the vibration, so that its window
/// has hardly anything of a start: for laws of which no steady orbit is looked for as well.
/// @param contact  the [friction] table's keys
std::string table_1_text(std::string_view contact);

scene::Scene table_1();

/// The scene with the sliding velocity that belongs to a velocity ratio.
scene::Scene at_velocity_ratio(scene::Scene scene, double velocity_ratio);

/// Of the vibration without a contact.
double peak_vibration_m_per_s(const scene::Scene& scene);

/// The scene for one carrier period on its steady orbit.
scene::Scene steady(scene::Scene scene);

double period_s(const scene::Scene& scene);

/// Kt X/Fc with the amplitude X of the vibration without a contact.
double dahl_number(const scene::Scene& scene);

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
