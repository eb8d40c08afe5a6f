/// Columns of numbers as a CSV file.
#pragma once

#include <string>
#include <vector>

namespace sonoglide::paper {

struct Column {
  std::string name;  ///< with its unit
  std::vector<double> values;
};

/// Numbers with 17 digits; `nan` below the end of a shorter column.
std::string to_csv(const std::vector<Column>& columns);

}  // namespace sonoglide::paper
