#include "host_sim/studies/identify/impedance/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sonoglide::identify::impedance {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double deviation_of_steps(std::vector<double> steps) {
  constexpr double deviation_of_median = 1.4826;
  return deviation_of_median * median(std::move(steps)) / std::sqrt(2.0);
}

}  // namespace sonoglide::identify::impedance
