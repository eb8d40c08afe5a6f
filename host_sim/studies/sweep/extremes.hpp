/// The lowest and the highest value of a figure over a sweep.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

struct Extremes {
  std::size_t lowest;   ///< point
  std::size_t highest;  ///< point
};

/// The first point of several with the same value; absent where the figure is NaN in every row.
std::optional<Extremes> extremes(const std::vector<Row>& rows, double Row::*figure);

}  // namespace sonoglide::sweep
