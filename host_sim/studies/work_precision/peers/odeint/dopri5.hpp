/// Boost.odeint's Dormand–Prince method, used as its manual has it.
#pragma once

#include <memory>

#include "host_sim/studies/work_precision/peers/contender.hpp"

namespace sonoglide::peers {

/// Adaptive steps over the plain right-hand side, sgn V taken from V; reversals are not looked for.
/// @param tolerance  absolute and relative, of each step
std::unique_ptr<Contender> odeint_dopri5(const Problem& problem, double tolerance);

}  // namespace sonoglide::peers
