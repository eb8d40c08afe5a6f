/// Columns of numbers as frequencies and admittances.
#pragma once

#include <array>
#include <complex>
#include <string>
#include <vector>

#include "host_sim/studies/identify/impedance/sweep_columns.hpp"
#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::identify::impedance {

/// @throws scene_file::SceneError  a frequency is not above 0
std::vector<double> frequencies_Hz(const MeasuredTable& table, const SweepColumn& column);

/// Of a form with phase the admittances, of one without their magnitudes.
/// @param tables  that of the first and that of the second column, of as many rows
/// @throws scene_file::SceneError  a magnitude is not above 0, or an admittance 0 or without end
std::vector<std::complex<double>> admittances_S(const std::array<const MeasuredTable*, 2>& tables,
                                                SweepColumns columns,
                                                std::vector<std::string>& warnings);

}  // namespace sonoglide::identify::impedance
