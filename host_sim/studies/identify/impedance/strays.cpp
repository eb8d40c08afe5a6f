#include "host_sim/studies/identify/impedance/selection.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace sonoglide::identify::impedance {
namespace {

/// Of the values up to `half` before and behind a place, without that at the place; the upper one of the
/// two in the middle.
double median_around(const Eigen::VectorXd& all, Eigen::Index at, Eigen::Index half) {
  std::vector<double> found;
  for (Eigen::Index i = std::max<Eigen::Index>(at - half, 0);
       i <= std::min(at + half, all.size() - 1); ++i) {
    if (i != at) {
      found.push_back(all(i));
    }
  }
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

bool is_stray(const Eigen::VectorXd& residuals, const Eigen::VectorXd& steps, Eigen::Index at) {
  constexpr double far = 8.0;
  constexpr double close_by = 4.0;
  constexpr double deviation_of_median = 1.4826 / 1.4142;  // of differences of two
  const double middle = median_around(residuals, at, 3);
  const double deviation =
      deviation_of_median * std::max(median_around(steps, at, 15), median_around(steps, at, 50));
  const auto is_off = [&](Eigen::Index i, double by) {
    return i >= 0 && i < residuals.size() && std::abs(residuals(i) - middle) > by * deviation;
  };
  return is_off(at, far) && !is_off(at - 1, close_by) && !is_off(at + 1, close_by);
}

}  // namespace

std::vector<std::size_t> find_strays(const CircuitFit& fit) {
  const Eigen::Index n = fit.at.log_magnitude.size();
  std::set<std::size_t> strays;
  for (Eigen::Index begin = 0; begin < fit.at.residuals.size(); begin += n) {
    const Eigen::VectorXd residuals = fit.at.residuals.segment(begin, n);
    const Eigen::VectorXd steps = (residuals.tail(n - 1) - residuals.head(n - 1)).cwiseAbs();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (is_stray(residuals, steps, i)) {
        strays.insert(static_cast<std::size_t>(i));
      }
    }
  }
  return {strays.begin(), strays.end()};
}

}  // namespace sonoglide::identify::impedance
