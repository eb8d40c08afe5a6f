#include "host_sim/studies/identify/impedance/strays.hpp"

#include <algorithm>
#include <array>
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

constexpr double far = 8.0;
constexpr double close_by = 4.0;

/// One residual a reading, of magnitude or of phase.
class Residuals {
 public:
  explicit Residuals(Eigen::VectorXd r) : r_(std::move(r)) {
    for (Eigen::Index i = 1; i < r_.size(); ++i) {
      steps_.push_back(std::abs(r_(i) - r_(i - 1)));
    }
  }

  /// How far the reading is off those around it, in standard deviations: the least of the
  /// distances to their median and to both neighbours.
  double off(Eigen::Index i) const {
    double least = std::abs(r_(i) - around(i));
    for (const Eigen::Index next : {i - 1, i + 1}) {
      if (next >= 0 && next < r_.size()) {
        least = std::min(least, std::abs(r_(i) - r_(next)));
      }
    }
    return least / deviation(i);
  }

  /// Whether the readings next to it are where the others are.
  bool neighbours_fit_in(Eigen::Index i) const {
    for (const Eigen::Index next : {i - 1, i + 1}) {
      if (next >= 0 && next < r_.size() &&
          std::abs(r_(next) - around(i)) >= close_by * deviation(i)) {
        return false;
      }
    }
    return true;
  }

 private:
  static constexpr std::array<Eigen::Index, 6> offsets = {-3, -2, -1, 1, 2, 3};

  double around(Eigen::Index i) const {
    std::vector<double> values;
    for (const Eigen::Index offset : offsets) {
      if (i + offset >= 0 && i + offset < r_.size()) {
        values.push_back(r_(i + offset));
      }
    }
    return median(std::move(values));
  }

  double deviation(Eigen::Index i) const {
    double usual = 1e-300;
    for (const std::ptrdiff_t half : {15, 50}) {
      const auto size = static_cast<std::ptrdiff_t>(steps_.size());
      const auto at = static_cast<std::ptrdiff_t>(i);
      usual = std::max(usual,
                       deviation_of_steps({steps_.begin() + std::max<std::ptrdiff_t>(at - half, 0),
                                           steps_.begin() + std::min(at + half, size)}));
    }
    return usual;
  }

  Eigen::VectorXd r_;
  std::vector<double> steps_;
};

}  // namespace

std::vector<std::size_t> find_strays(const CircuitFit& fit) {
  const Eigen::Index n = fit.at.log_magnitude.size();
  std::vector<Residuals> parts;
  for (Eigen::Index begin = 0; begin < fit.at.residuals.size(); begin += n) {
    parts.emplace_back(fit.at.residuals.segment(begin, n));
  }
  std::vector<std::size_t> strays;
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool is_off = std::any_of(parts.begin(), parts.end(),
                                    [&](const Residuals& part) { return part.off(i) > far; });
    if (is_off && std::all_of(parts.begin(), parts.end(),
                              [&](const Residuals& part) { return part.neighbours_fit_in(i); })) {
      strays.push_back(static_cast<std::size_t>(i));
    }
  }
  return strays;
}

}  // namespace sonoglide::identify::impedance
