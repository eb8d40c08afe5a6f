#include "host_sim/output/number.hpp"

#include <algorithm>
#include <array>

#include "host_sim/process/printable.hpp"

namespace sonoglide::output {

std::string csv_cells(const std::vector<double>& figures, int digits) {
  std::string cells;
  for (const double each : figures) {
    cells += (cells.empty() ? "" : ",") + csv_number(each, digits);
  }
  return cells;
}

std::string csv_cell(std::string_view text) {
  std::string line = process::printable(text);
  if (line.find_first_of(",\"") == std::string::npos) {
    return line;
  }
  std::string cell = "\"";
  for (const char each : line) {
    cell += each == '"' ? "\"\"" : std::string(1, each);
  }
  return cell + '"';
}

std::string plain_zero(std::string number) {
  const bool is_signed_zero = !number.empty() && (number[0] == '-' || number[0] == '+') &&
                              number.find_first_not_of("+-0.") == std::string::npos;
  return is_signed_zero ? "0" : number;
}

std::string quantity(double value, std::string_view unit, int digits) {
  if (!std::isfinite(value) || value == 0.0) {
    return std::isfinite(value) ? fmt::format("0 {}", unit) : std::string("-");
  }
  static constexpr std::array<const char*, 10> prefixes = {"f", "p", "n", "u", "m",
                                                           "",  "k", "M", "G", "T"};
  constexpr int without = 5;
  constexpr int last = static_cast<int>(prefixes.size()) - 1;
  // What rounds to 1000 has the next prefix.
  const double rounded = std::abs(value) * (1.0 + 0.5 * std::pow(10.0, -digits));
  const double thousands = std::floor(std::log10(rounded) / 3.0);
  const int index = std::clamp(static_cast<int>(thousands) + without, 0, last);
  return fmt::format("{:.{}g} {}{}", value * std::pow(1000.0, without - index), digits,
                     prefixes.at(static_cast<std::size_t>(index)), unit);
}

}  // namespace sonoglide::output
