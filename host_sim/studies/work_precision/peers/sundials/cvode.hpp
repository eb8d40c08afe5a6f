/// SUNDIALS CVODE with root finding at the reversals, as its manual recommends for a right-hand
/// side with a kink.
#pragma once

#include <memory>

#include "host_sim/studies/work_precision/peers/contender.hpp"

namespace sonoglide::peers {

/// Variable-order Adams method; Newton iteration with the exact dense Jacobian. Between two roots
/// of V its sign is frozen, so that the right-hand side is smooth; at a root the method starts
/// afresh.
/// @param tolerance  absolute and relative, of each step
std::unique_ptr<Contender> cvode_adams(const Problem& problem, double tolerance);

/// The same with fixed-point iteration, which needs no Jacobian: for contacts that are not stiff.
/// @param tolerance  absolute and relative, of each step
std::unique_ptr<Contender> cvode_adams_fixed_point(const Problem& problem, double tolerance);

/// Backward differentiation formulas with Newton iteration, for stiff contacts.
/// @param tolerance  absolute and relative, of each step
std::unique_ptr<Contender> cvode_bdf(const Problem& problem, double tolerance);

}  // namespace sonoglide::peers
