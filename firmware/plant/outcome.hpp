/// Result and cost of an advance of a solver.
#pragma once

#include <cstdint>

namespace sonoglide::plant {

enum class Error {
  none,
  not_finite,             ///< displacement, velocity or friction is, or would be, no number
  friction_bound_broken,  ///< |phi| > 1: the step is too long for the contact
  too_many_steps,         ///< the step limit of an advance was reached
  step_too_long,          ///< for the contact or the oscillator, seen before the state shows it
};

/// After an error the state is that of `offset`: for too_many_steps, step_too_long and a step that
/// could not be begun the last one reached, otherwise the first one that is wrong.
template <class Scalar>
struct Outcome {
  Error error = Error::none;
  Scalar offset = Scalar(0);  ///< time since the interval began; its duration if there is no error
};

/// Totals since the solver was configured.
struct Cost {
  std::uint64_t steps = 0;
  std::uint64_t events = 0;  ///< reversals of the sliding velocity, sticks and releases
};

inline constexpr std::uint32_t max_steps_per_advance = 1000000;

}  // namespace sonoglide::plant
