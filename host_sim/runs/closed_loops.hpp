/// Many independent closed loops at once, their plants in SIMD lanes.
#pragma once

#include <vector>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::runs {

/// Largest tolerance and error are one: see run_closed_loops.
inline constexpr double closed_loop_tolerance = 1e-6;

/// A loop to be run; all that it refers to outlives the run.
struct ClosedLoop {
  const scene::Scene& scene;
  const configure::ControlDesign& design;
  loop::PeriodSink& periods;  ///< gets each whole carrier period
};

struct LoopRun {
  batch::RunStatus status = batch::RunStatus::outside_range;
  loop::ControlRecord control;  ///< as loop::run has it; of a loop that is solved
};

/// Whether the lanes can run the loop: those whose plant they take (see lane_plant), with a tolerance
/// of 1e-6 or more, that last a carrier period and observe no vibration.
bool runs_in_lanes(const scene::Scene& closed_loop);

/// Runs loops as loop::run does, with its controllers, sensors and actuators, one by one, and their
/// plants in lanes. Result i is that of loops[i].
///
/// A loop's result is the same, bit for bit, whatever its lane, its neighbours and the way a caller
/// divides the loops among threads, and on every instruction set.
/// Error of the friction ratio of a carrier period against loop::run at tolerance 1e-10: 1e-6 of
/// Table 1 and near it. A loop that the lanes give up says so in its status and disturbs no other:
/// let loop::run have it.
/// @param loops  such as runs_in_lanes allows; some hundreds keep the lanes busy
/// @throws what the sinks throw
std::vector<LoopRun> run_closed_loops(const std::vector<ClosedLoop>& loops);

}  // namespace sonoglide::runs
