#include "host_sim/studies/sweep/extremes.hpp"

#include <cmath>

namespace sonoglide::sweep {

std::optional<Extremes> extremes(const std::vector<Row>& rows, double Row::*figure) {
  std::optional<Extremes> found;
  for (std::size_t point = 0; point < rows.size(); ++point) {
    const double value = rows[point].*figure;
    if (std::isnan(value)) {
      continue;
    }
    if (!found) {
      found = Extremes{point, point};
    }
    if (value < rows[found->lowest].*figure) {
      found->lowest = point;
    }
    if (value > rows[found->highest].*figure) {
      found->highest = point;
    }
  }
  return found;
}

}  // namespace sonoglide::sweep
