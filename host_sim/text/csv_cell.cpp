#include "host_sim/text/csv_cell.hpp"

#include "host_sim/text/printable.hpp"

namespace sonoglide::text {

std::string csv_cell(std::string_view text) {
  std::string line = printable(text);
  if (line.find_first_of(",\"") == std::string::npos) {
    return line;
  }
  std::string cell = "\"";
  for (const char each : line) {
    cell += each == '"' ? "\"\"" : std::string(1, each);
  }
  return cell + '"';
}

}  // namespace sonoglide::text
