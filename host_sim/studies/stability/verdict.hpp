/// What became of one run of a solver.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability {

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

}  // namespace sonoglide::stability
