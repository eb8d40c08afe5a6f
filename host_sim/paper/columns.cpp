#include "host_sim/paper/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

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
  for (std::size_t row = 0; row < rows; ++row) {
    const char* separator = "";
    for (const Column& column : columns) {
      text += separator;
      if (row < column.values.size() && !std::isnan(column.values[row])) {
        fmt::format_to(std::back_inserter(text), "{:.17g}", column.values[row]);
      }
      separator = ",";
    }
    text += '\n';
  }
  return text;
}

}  // namespace sonoglide::paper
