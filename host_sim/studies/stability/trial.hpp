/// One run of one solver over one scene, and what it shows of the solver.
#pragma once

#include <cstdint>

#include "firmware/plant/outcome.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::stability {

struct TrialPlan {
  int periods;               ///< carrier periods, of the plant's own clock where there is no drive
  double setting;            ///< tolerance of an adaptive solver, else steps per period
  std::uint32_t step_limit;  ///< per period
};

struct TrialResult {
  bool supported = true;          ///< false: the solver does not take this friction law
  bool finite = true;             ///< all that the solver handed over as good
  double largest_friction = 0.0;  ///< max |F|/Fc over the ends of its steps
  double friction_ratio = 0.0;    ///< mean(F)/Fc over all periods, positive along the sliding
  double balance_residual = 0.0;  ///< see witness.hpp
  plant::Error error = plant::Error::none;  ///< what the solver itself said
};

/// Stops at the first error that the solver reports; what it did before counts.
using Trial = TrialResult (*)(const scene::Scene& scene, const TrialPlan& plan);

}  // namespace sonoglide::stability
