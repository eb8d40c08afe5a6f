#include "host_sim/studies/identify/impedance/readings.hpp"

#include <cmath>

namespace sonoglide::identify::impedance {

std::vector<double> frequencies_Hz(const MeasuredTable& table, const SweepColumn& column) {
  std::vector<double> result = table.numbers(column.index);
  for (std::size_t row = 0; row < result.size(); ++row) {
    result[row] = column.name.value(result[row]);
    if (!(result[row] > 0.0) || !std::isfinite(result[row])) {
      throw table.error(row, column.index, "is no frequency; allowed: above 0");
    }
  }
  return result;
}

std::vector<std::complex<double>> admittances_S(const std::array<const MeasuredTable*, 2>& tables,
                                                SweepColumns columns,
                                                std::vector<std::string>& warnings) {
  const MeasuredTable& table = *tables[0];
  const std::vector<double> first = table.numbers(columns.first.index);
  const std::vector<double> second = columns.second ? tables[1]->numbers(columns.second->index)
                                                    : std::vector<double>(first.size());
  if (const std::string assumed = columns.complete_unit(second); !assumed.empty()) {
    warnings.push_back(assumed);
  }
  std::vector<std::complex<double>> result(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!columns.rectangular() && !(columns.first.name.value(first[row]) > 0.0)) {
      throw table.error(row, columns.first.index, "is no magnitude; allowed: above 0");
    }
    result[row] = columns.admittance_S(first[row], second[row]);
    if (!std::isfinite(std::abs(result[row])) || std::abs(result[row]) == 0.0) {
      throw table.error(row, columns.first.index,
                        "has an admittance of 0 or without end; allowed: one of a capacitance");
    }
  }
  return result;
}

}  // namespace sonoglide::identify::impedance
