#include "host_sim/studies/identify/impedance/strays.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sonoglide::identify::impedance {
namespace {

/// The upper one of the two in the middle. @param values  at least one
double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Values up to `half` before and behind a place, without that at the place.
std::vector<double> around(const std::vector<double>& all, std::ptrdiff_t at, std::ptrdiff_t half) {
  const auto size = static_cast<std::ptrdiff_t>(all.size());
  std::vector<double> found(all.begin() + std::max<std::ptrdiff_t>(at - half, 0), all.begin() + at);
  found.insert(found.end(), all.begin() + std::min(at + 1, size),
               all.begin() + std::min(at + half + 1, size));
  return found;
}

/// Whether a residual is far off those around it, in standard deviations; negative where a neighbour is.
double standing(const std::vector<double>& residuals, const std::vector<double>& steps,
                std::ptrdiff_t at) {
  constexpr double close_by = 4.0;
  constexpr double deviation_of_median = 1.4826 / 1.4142;  // of differences of two
  const double middle = median(around(residuals, at, 3));
  const double deviation = std::max({deviation_of_median * median(around(steps, at, 15)),
                                     deviation_of_median * median(around(steps, at, 50)), 1e-300});
  for (const double next : around(residuals, at, 1)) {
    if (std::abs(next - middle) > close_by * deviation) {
      return -1.0;
    }
  }
  return std::abs(residuals[static_cast<std::size_t>(at)] - middle) / deviation;
}

}  // namespace

std::vector<std::size_t> find_strays(const CircuitFit& fit) {
  constexpr double far = 8.0;
  const Eigen::Index n = fit.at.log_magnitude.size();
  std::vector<double> off(static_cast<std::size_t>(n), 0.0);
  for (Eigen::Index begin = 0; begin < fit.at.residuals.size(); begin += n) {
    const auto part = fit.at.residuals.segment(begin, n);
    const std::vector<double> residuals(part.begin(), part.end());
    std::vector<double> steps;
    for (std::size_t i = 1; i < residuals.size(); ++i) {
      steps.push_back(std::abs(residuals[i] - residuals[i - 1]));
    }
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const double found = standing(residuals, steps, static_cast<std::ptrdiff_t>(i));
      off[i] = off[i] < 0.0 || found < 0.0 ? -1.0 : std::max(off[i], found);
    }
  }
  std::vector<std::size_t> strays;
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (off[i] > far) {
      strays.push_back(i);
    }
  }
  return strays;
}

}  // namespace sonoglide::identify::impedance
