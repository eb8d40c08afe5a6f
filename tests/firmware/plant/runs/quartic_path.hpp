/// A velocity over a step, given as a quartic.
#pragma once

#include <array>

#include "firmware/plant/velocity_path.hpp"

namespace sonoglide::plant {

/// A quartic by its values, for the path to find again.
inline VelocityPath<double> path_through(const std::array<double, 5>& p, double length) {
  const auto end = [&](double x) {
    return PathEnd<double>{(((p[4] * x + p[3]) * x + p[2]) * x + p[1]) * x + p[0],
                           (((4.0 * p[4] * x + 3.0 * p[3]) * x + 2.0 * p[2]) * x + p[1]) / length};
  };
  const double mean = p[0] + p[1] / 2.0 + p[2] / 3.0 + p[3] / 4.0 + p[4] / 5.0;
  return {end(0.0), end(1.0), mean, length};
}

}  // namespace sonoglide::plant
