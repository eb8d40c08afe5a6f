#include "host_sim/studies/paper/columns.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "host_sim/output/csv_number.hpp"

namespace sonoglide::paper {

std::string to_csv(const std::vector<Column>& columns) {
  std::string text;
  for (const Column& column : columns) {
    text += (text.empty() ? "" : ",") + column.name;
  }
  text += '\n';
  std::size_t rows = 0;
  for (const Column& column : columns) {
    rows = std::max(rows, column.values.size());
  }
  constexpr int digits = 17;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t row = 0; row < rows; ++row) {
    const char* separator = "";
    for (const Column& column : columns) {
      const double value = row < column.values.size() ? column.values[row] : none;
      text += separator + output::csv_number(value, digits);
      separator = ",";
    }
    text += '\n';
  }
  return text;
}

}  // namespace sonoglide::paper
