#include "tests/acceptance/program/csv.hpp"

#include <sstream>

namespace sonoglide::acceptance {

std::vector<Cells> csv_rows(const std::string& text) {
  std::vector<Cells> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line + ",");
    Cells& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) {
      row.push_back(cell);
    }
  }
  return rows;
}

}  // namespace sonoglide::acceptance
