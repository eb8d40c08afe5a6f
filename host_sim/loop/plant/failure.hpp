/// A simulation that could not be carried through, and why, in words.
#pragma once

#include <stdexcept>
#include <string>

#include "firmware/plant/outcome.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// The computation failed; what() gives time, state and reason.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Why the solver gave up, and what would do; where the steps ran out, what they were spent on.
std::string failure_cause(const scene::Scene& scene, plant::Error error, const plant::Cost& cost);

/// Time, state and cause.
std::string failure_reason(const scene::Scene& scene, plant::Error error, double time_s,
                           const PlantState& state, const plant::Cost& cost);

}  // namespace sonoglide::loop
