#include "host_sim/batch/dahl_friction_ratios.hpp"

#include <algorithm>

#define HWY_TARGET_INCLUDE "host_sim/batch/ratio_lanes.hpp"
#include <hwy/foreach_target.h>
// The last of the targets is left to this one.
#include "host_sim/batch/ratio_lanes.hpp"

namespace sonoglide::batch {

HWY_EXPORT(fill_ratios);

void dahl_friction_ratios(const double* velocity_ratios, const double* dahl_numbers,
                          std::size_t count, double* ratios) {
  HWY_DYNAMIC_DISPATCH(fill_ratios)(velocity_ratios, dahl_numbers, count, ratios);
}

std::vector<double> dahl_friction_ratios(const std::vector<double>& velocity_ratios,
                                         const std::vector<double>& dahl_numbers) {
  std::vector<double> ratios(std::min(velocity_ratios.size(), dahl_numbers.size()));
  dahl_friction_ratios(velocity_ratios.data(), dahl_numbers.data(), ratios.size(), ratios.data());
  return ratios;
}

}  // namespace sonoglide::batch
