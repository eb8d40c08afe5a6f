/// How tables, JSON and pages write a number and a text.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sonoglide::output {

/// Digits that tell a double to its last bit.
inline constexpr int every_bit = 17;

/// A figure that is not defined is `nan`, whatever its bits: every cell of a column of numbers
/// reads as one.
inline std::string csv_number(double value, int digits = every_bit) {
  return std::isnan(value) ? "nan" : fmt::format("{:.{}g}", value, digits);
}

/// Figures as cells.
std::string csv_cells(const std::vector<double>& figures, int digits = every_bit);

/// A text as a cell of CSV (RFC 4180): in quotes where it has a comma or a quote, printable (see
/// printable()), so that a row is a line.
std::string csv_cell(std::string_view text);

/// A figure in JSON; null where it is not finite.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// A figure; null where there is none.
inline nlohmann::ordered_json json_number(const std::optional<double>& value) {
  return value ? json_number(*value) : nlohmann::ordered_json(nullptr);
}

/// The text of a number, without sign and digits where it is 0 to its last digit: `0` for `-0.000`.
std::string plain_zero(std::string number);

/// A figure for a person; `-` where it is not finite.
/// @param format  of fmt
inline std::string formatted(double value, const char* format) {
  return std::isfinite(value) ? plain_zero(fmt::format(fmt::runtime(format), value))
                              : std::string("-");
}

/// A figure with the prefix that suits, from femto to tera: `526.3 N`, `26.72 mm/s`; `-` where it is
/// not finite.
std::string quantity(double value, std::string_view unit, int digits = 4);

}  // namespace sonoglide::output
