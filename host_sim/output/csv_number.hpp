/// How the tables write a number.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace sonoglide::output {

/// A figure that is not defined is `nan`, whatever its bits: every cell of a column of numbers
/// reads as one.
inline std::string csv_number(double value, int digits) {
  return std::isnan(value) ? "nan" : fmt::format("{:.{}g}", value, digits);
}

}  // namespace sonoglide::output
