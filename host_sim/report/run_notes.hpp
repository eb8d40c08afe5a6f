/// What the simulation of a run saw that no controller can say.
#pragma once

#include <string>
#include <vector>

#include "host_sim/loop/run_result.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// What the true current may exceed its limit by before it is told: rounding, and a controller that
/// holds the limit to its last bits.
inline constexpr double told_current_excess = 1.001;

/// A sentence each: a current above its limit, a contact that a normal vibration opens.
std::vector<std::string> run_notes(const scene::Scene& scene, const loop::RunResult& result);

/// Of target steps that a run cannot show, a sentence each: those at or after its end, and those within the
/// settling band about 0. Known before the run; of a texture none.
std::vector<std::string> target_notes(const scene::Scene& scene);

/// How a contact that vibrates normally was loaded over the window.
struct ContactLoadFigures {
  double open_fraction;        ///< of the time, without contact
  double mean_normal_force_N;  ///< over all of it
};
ContactLoadFigures contact_load(const loop::EnergyBalance& window);

}  // namespace sonoglide::report
