/// How many steps a run will take, before it begins.
#pragma once

#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Steps that the solver is expected to take in a whole run: as many in all of it as in its second
/// carrier period, or in as much of the first two as a million steps reach. A closed loop is taken to
/// drive at its limit. Without a drive a period is a thousandth of the run.
///
/// Right to a factor of 3 where the motion goes on as it begins. A contact that comes loose,
/// or sticks, later than that is not foreseen.
double expected_steps(const scene::Scene& scene);

}  // namespace sonoglide::loop
