/// One run of one solver over one scene, and what it shows of the solver.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

/// declined_*: the solver itself reported an error. silent_*: it handed the state over as good.
enum class Verdict {
  good,
  wrong,  ///< finite and bounded, but off: the one that nothing in the result gives away
  silent_friction_bound,
  silent_not_finite,
  declined_friction_bound,
  declined_step_too_long,
  declined_not_finite,
  declined_too_many_steps,
  unsupported,  ///< the solver does not take this friction law
};

inline constexpr std::size_t verdict_count = 9;

/// @param error         how far off the result is; NaN is too far
/// @param allowed_error the most that is good
/// @param bound         the largest |F|/Fc that is none of the solver's fault
Verdict judge(const TrialResult& result, double error, double allowed_error, double bound);

/// For files: the names in order, good and wrong as each kind of experiment calls them.
std::array<std::string_view, verdict_count> verdict_names(std::string_view good,
                                                          std::string_view wrong);

// The solvers whose limits are drawn.

/// A solver in one arithmetic.
struct TriedPrecision {
  std::string_view name;
  Trial trial;
  double extreme_setting;  ///< tolerance or steps per period, for the random scenes
  double friction_bound;   ///< largest |F|/Fc that the solver lets pass
};

struct TriedSolver {
  std::string name;
  bool adaptive;  ///< set by a tolerance, else by a number of steps per period
  std::array<TriedPrecision, 2> precisions;  ///< float64, float32
};

const std::vector<TriedSolver>& solvers();

}  // namespace sonoglide::stability
