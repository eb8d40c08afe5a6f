#include "host_sim/studies/identify/impedance/strays.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sonoglide::identify::impedance {
namespace {

/// The upper one of the two in the middle. @param values  at least one
double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Standard deviation of Gaussian readings by the median of the distances from each to the next.
double deviation_of_steps(std::vector<double> steps) {
  constexpr double deviation_of_median = 1.4826;
  return deviation_of_median * median(std::move(steps)) / std::sqrt(2.0);
}

/// How a reading stands to those around it, in standard deviations of magnitude or phase.
struct Standing {
  double off;         ///< the least of the distances to their median and to both neighbours
  double neighbours;  ///< the largest distance of a neighbour from that median
};

Standing standing(const std::vector<double>& residuals, const std::vector<double>& steps,
                  std::ptrdiff_t at) {
  const auto size = static_cast<std::ptrdiff_t>(residuals.size());
  const auto value = [&](std::ptrdiff_t i) { return residuals[static_cast<std::size_t>(i)]; };
  std::vector<double> around;
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(at - 3, 0); i < std::min(at + 4, size); ++i) {
    if (i != at) {
      around.push_back(value(i));
    }
  }
  const double middle = median(std::move(around));
  double deviation = 1e-300;
  for (const std::ptrdiff_t half : {15, 50}) {
    deviation = std::max(deviation,
                         deviation_of_steps({steps.begin() + std::max<std::ptrdiff_t>(at - half, 0),
                                             steps.begin() + std::min(at + half, size - 1)}));
  }
  Standing found{std::abs(value(at) - middle) / deviation, 0.0};
  for (const std::ptrdiff_t next : {at - 1, at + 1}) {
    if (next >= 0 && next < size) {
      found.off = std::min(found.off, std::abs(value(at) - value(next)) / deviation);
      found.neighbours = std::max(found.neighbours, std::abs(value(next) - middle) / deviation);
    }
  }
  return found;
}

}  // namespace

std::vector<std::size_t> find_strays(const CircuitFit& fit) {
  constexpr double far = 8.0;
  constexpr double close_by = 4.0;
  const Eigen::Index n = fit.at.log_magnitude.size();
  std::vector<Standing> readings(static_cast<std::size_t>(n), {0.0, 0.0});
  for (Eigen::Index begin = 0; begin < fit.at.residuals.size(); begin += n) {
    const auto part = fit.at.residuals.segment(begin, n);
    const std::vector<double> residuals(part.begin(), part.end());
    std::vector<double> steps;
    for (std::size_t i = 1; i < residuals.size(); ++i) {
      steps.push_back(std::abs(residuals[i] - residuals[i - 1]));
    }
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const Standing found = standing(residuals, steps, static_cast<std::ptrdiff_t>(i));
      readings[i] = {std::max(readings[i].off, found.off),
                     std::max(readings[i].neighbours, found.neighbours)};
    }
  }
  std::vector<std::size_t> strays;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (readings[i].off > far && readings[i].neighbours < close_by) {
      strays.push_back(i);
    }
  }
  return strays;
}

}  // namespace sonoglide::identify::impedance
