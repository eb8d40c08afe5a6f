#include "tests/common/csv/csv.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <utility>

namespace sonoglide::csv {
namespace {

std::string place(const std::string& table, std::size_t line) {
  return table + ":" + std::to_string(line) + ": ";
}

/// Takes one cell; `at` is then behind it.
std::string take_cell(const std::string& line, std::size_t& at, const std::string& place) {
  if (at >= line.size() || line[at] != '"') {
    const std::size_t end = std::min(line.find(',', at), line.size());
    const std::string cell = line.substr(at, end - at);
    at = end;
    return cell;
  }
  std::string cell;
  for (++at; at < line.size(); ++at) {
    if (line[at] != '"') {
      cell += line[at];
    } else if (at + 1 < line.size() && line[at + 1] == '"') {
      cell += line[++at];
    } else {
      ++at;
      if (at < line.size() && line[at] != ',') {
        throw CsvError(place + "text after a quoted cell");
      }
      return cell;
    }
  }
  throw CsvError(place + "a quoted cell does not end");
}

Cells cells_of(const std::string& line, const std::string& place) {
  Cells cells;
  std::size_t at = 0;
  cells.push_back(take_cell(line, at, place));
  while (at < line.size()) {
    ++at;  // the comma
    cells.push_back(take_cell(line, at, place));
  }
  return cells;
}

std::shared_ptr<const Heading> heading_of(std::istream& lines, const std::string& name) {
  std::string line;
  if (!std::getline(lines, line)) {
    throw CsvError(name + ": is empty; a table has a heading");
  }
  Heading heading{name, cells_of(line, place(name, 1))};
  const std::set<std::string> distinct(heading.columns.begin(), heading.columns.end());
  if (distinct.size() != heading.columns.size()) {
    throw CsvError(place(name, 1) + "a column is there twice: " + line);
  }
  return std::make_shared<const Heading>(std::move(heading));
}

}  // namespace

Row::Row(std::shared_ptr<const Heading> heading, std::size_t line, Cells cells)
    : heading_(std::move(heading)), line_(line), cells_(std::move(cells)) {
  if (cells_.size() != heading_->columns.size()) {
    throw CsvError(place(heading_->table, line_) + std::to_string(cells_.size()) + " cells, but " +
                   std::to_string(heading_->columns.size()) + " columns");
  }
}

const std::string& Row::text(const std::string& column) const {
  const Cells& columns = heading_->columns;
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) {
    throw CsvError(heading_->table + ": has no column " + column);
  }
  return cells_[static_cast<std::size_t>(found - columns.begin())];
}

double Row::number(const std::string& column) const {
  const std::string& cell = text(column);
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0') {
    throw not_a_number(column);
  }
  return value;
}

long double Row::long_number(const std::string& column) const {
  const std::string& cell = text(column);
  char* end = nullptr;
  const long double value = std::strtold(cell.c_str(), &end);
  if (cell.empty() || *end != '\0') {
    throw not_a_number(column);
  }
  return value;
}

CsvError Row::not_a_number(const std::string& column) const {
  return CsvError(place(heading_->table, line_) + column + ": \"" + text(column) +
                  "\" is not a number");
}

Table::Table(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  heading_ = heading_of(lines, name);
  std::size_t number = 1;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    rows_.emplace_back(heading_, number, cells_of(line, place(name, number)));
  }
}

std::vector<double> Table::numbers(const std::string& column) const {
  if (std::find(columns().begin(), columns().end(), column) == columns().end()) {
    throw CsvError(heading_->table + ": has no column " + column);
  }
  std::vector<double> all;
  for (const Row& row : rows_) {
    all.push_back(row.number(column));
  }
  return all;
}

const Row& Table::row_of(const std::string& column, const std::string& text) const {
  const Row* found = nullptr;
  for (const Row& row : rows_) {
    if (row.text(column) == text) {
      if (found != nullptr) {
        throw CsvError(heading_->table + ": has several rows with " + column + " " + text);
      }
      found = &row;
    }
  }
  if (found == nullptr) {
    throw CsvError(heading_->table + ": has no row with " + column + " " + text);
  }
  return *found;
}

Table read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw CsvError(path.string() + ": cannot be read");
  }
  return Table({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()},
               path.string());
}

}  // namespace sonoglide::csv
