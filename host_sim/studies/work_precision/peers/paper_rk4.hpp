/// The paper's own method: the classical Runge–Kutta method with a fixed step, written out for this
/// one equation as a user after speed would.
#pragma once

#include <memory>

#include "host_sim/studies/work_precision/peers/contender.hpp"

namespace sonoglide::peers {

/// The drive is read from a table of one carrier period.
/// @param steps_per_period  a whole number, > 0
std::unique_ptr<Contender> rk4_table(const Problem& problem, double steps_per_period);

/// The drive is computed by std::cos at each new instant, two for each step.
/// @param steps_per_period  a whole number, > 0
std::unique_ptr<Contender> rk4_naive(const Problem& problem, double steps_per_period);

}  // namespace sonoglide::peers
