#include "host_sim/studies/work_precision/settings.hpp"

#include <cmath>

namespace sonoglide::work_precision {

std::vector<double> tolerances(int first, int last) {
  std::vector<double> all;
  for (int half_decades = 2 * first; half_decades <= 2 * last; ++half_decades) {
    // Two digits, so that the text of a setting is the setting.
    const int decade = (half_decades + 1) / 2;
    const double digits = half_decades % 2 == 0 ? 1.0 : 3.2;
    all.push_back(digits * std::pow(10.0, -decade));
  }
  return all;
}

std::vector<double> step_counts(int first_decade, int last_decade) {
  std::vector<double> all;
  for (int decade = first_decade; decade < last_decade; ++decade) {
    for (const double digits : {1.0, 1.8, 3.2, 5.6}) {
      all.push_back(std::round(digits * std::pow(10.0, decade)));
    }
  }
  all.push_back(std::pow(10.0, last_decade));
  return all;
}

}  // namespace sonoglide::work_precision
