/// How the tables write a number and a text.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace sonoglide::output {

/// A figure that is not defined is `nan`, whatever its bits: every cell of a column of numbers
/// reads as one.
inline std::string csv_number(double value, int digits) {
  return std::isnan(value) ? "nan" : fmt::format("{:.{}g}", value, digits);
}

/// Figures as a row, to their last bit.
std::string csv_row(const std::vector<double>& figures);

/// A text as a cell of CSV (RFC 4180): in quotes where it has a comma or a quote, printable (see
/// printable()), so that a row is a line.
std::string csv_cell(std::string_view text);

}  // namespace sonoglide::output
