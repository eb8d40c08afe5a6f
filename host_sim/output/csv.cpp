#include "host_sim/output/csv.hpp"

#include "host_sim/process/printable.hpp"

namespace sonoglide::output {

std::string csv_row(const std::vector<double>& figures) {
  constexpr int every_bit = 17;
  std::string row;
  for (const double each : figures) {
    row += (row.empty() ? "" : ",") + csv_number(each, every_bit);
  }
  return row + '\n';
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

}  // namespace sonoglide::output
