/// The largest value of a function over a cube, without its derivatives.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace sonoglide::robust {

/// A place in the cube [0, 1]^n.
using Place = std::vector<double>;

/// Called with the places one after the other, `run` counting them from 0.
using Function = std::function<double(std::size_t run, const Place& place)>;

/// Climbs from a place to a higher one: COBYLA (Powell 1994) of NLopt, which models the function as
/// linear in a region that shrinks. Deterministic. The last run moves what is within 1e-3 of a face
/// of the cube onto it: a corner is met to the bit. Inside the cube a smooth maximum is met to about
/// 1e-3 of its edges.
/// @param runs  at most, > 0
void climb(const Place& start, std::size_t runs, const Function& function);

}  // namespace sonoglide::robust
