/// The closed-form friction-ratio map at many points at once, one in each SIMD lane.
#pragma once

#include <cstddef>
#include <vector>

namespace sonoglide::batch {

/// ratios[i] = friction::dahl_friction_ratio(velocity_ratios[i], dahl_numbers[i]), i < count.
///
/// Error ≤ 1e-12 for dahl_numbers in [1e-4, 1e7], tested against that function. A point's result
/// does not depend on its neighbours; from one instruction set to another the rounding differs.
void dahl_friction_ratios(const double* velocity_ratios, const double* dahl_numbers,
                          std::size_t count, double* ratios);

/// The same for vectors of one size.
std::vector<double> dahl_friction_ratios(const std::vector<double>& velocity_ratios,
                                         const std::vector<double>& dahl_numbers);

}  // namespace sonoglide::batch
