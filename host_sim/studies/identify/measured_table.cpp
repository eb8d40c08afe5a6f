#include "host_sim/studies/identify/measured_table.hpp"

#include <fmt/format.h>

#include <utility>

namespace sonoglide::identify {
namespace {

using scene_file::SceneError;

std::string counted(const std::vector<Cell>& cells) {
  return cells.size() > most_cells ? fmt::format("more than {}", most_cells)
                                   : fmt::format("{}", cells.size());
}

/// The mark of a number's fraction; 0 where it has none.
char decimal_mark(std::string_view cell) {
  const std::size_t at = cell.find_first_of(".,");
  return at == std::string_view::npos || !is_numeric(cell, true) ? '\0' : cell[at];
}

/// As `28,000`: 28 with a decimal comma, and a thousand times as much without one.
bool may_have_thousands(std::string_view cell) {
  constexpr std::size_t group = 3;
  const std::size_t first = cell.find_first_of("0123456789");
  const std::size_t comma = cell.find(',');
  return comma - first <= group && cell.size() == comma + 1 + group && cell[first] != '0' &&
         cell.find_first_not_of("0123456789", comma + 1) == std::string_view::npos;
}

}  // namespace

std::string unit_in_brackets(const std::string& name) {
  const std::size_t open = name.find_last_of("([");
  if (open == std::string::npos) {
    return {};
  }
  const std::size_t close = name.find_first_of(")]", open);
  return name.substr(open + 1, close == std::string::npos ? close : close - open - 1);
}

MeasuredTable::MeasuredTable(const scene_file::Source& source, const IsWanted& is_wanted)
    : source_(source) {
  FoundTable found = find_table(source, is_wanted);
  heading_ = std::move(found.heading);
  rows_ = std::move(found.rows);
  if (!found.warning.empty()) {
    warnings_.push_back(std::move(found.warning));
  }
  check();
}

MeasuredTable::MeasuredTable(const scene_file::Source& source, Heading heading,
                             std::vector<Line> rows)
    : source_(source), heading_(std::move(heading)), rows_(std::move(rows)) {
  check();
}

void MeasuredTable::check() {
  if (rows_.empty()) {
    throw heading_error("no row of numbers below the heading; allowed: at least one");
  }
  require_no_surplus();
  require_one_decimal_mark();
}

void MeasuredTable::require_no_surplus() const {
  for (const Line& row : rows_) {
    const std::vector<Cell> cells = cells_of(row.text, heading_.separator);
    for (std::size_t i = names().size(); i < cells.size(); ++i) {
      if (!cells[i].text.empty() || i == most_cells) {
        throw SceneError(
            {source_.file, row.number, cells[i].column}, "row",
            fmt::format("cells on this line: {}; allowed: one for each of the {} columns{}",
                        counted(cells), names().size(),
                        heading_.separator == ','
                            ? "; numbers with decimal commas need semicolons or tabs "
                              "between them"
                            : ""));
      }
    }
  }
}

void MeasuredTable::require_one_decimal_mark() {
  if (heading_.separator == ',') {
    return;
  }
  std::string_view first;
  std::size_t line_of_first = 0;
  bool may_be_thousands = true;
  for (const Line& row : rows_) {
    for (const Cell& each : cells_of(row.text, heading_.separator)) {
      const char found = decimal_mark(each.text);
      if (found == '\0') {
        continue;
      }
      if (first.empty()) {
        first = each.text;
        line_of_first = row.number;
      } else if (const char mark = decimal_mark(first); found != mark) {
        throw SceneError(
            {source_.file, row.number, each.column}, "row",
            fmt::format("\"{}\" has a decimal {}, and line {} has decimal {}; allowed: "
                        "one of them in a file, and nothing between thousands",
                        shortened(each.text), found == ',' ? "comma" : "point", line_of_first,
                        mark == ',' ? "commas" : "points"));
      }
      may_be_thousands = may_be_thousands && found == ',' && may_have_thousands(each.text);
    }
  }
  if (!first.empty() && may_be_thousands) {
    warnings_.push_back(fmt::format(
        "The commas of numbers as \"{}\" on line {} are taken for decimal commas; where they "
        "stand between thousands, take them out.",
        shortened(first), line_of_first));
  }
}

Cell MeasuredTable::cell(std::size_t row, std::size_t column) const {
  const std::vector<Cell> cells = cells_of(rows_[row].text, heading_.separator);
  if (column >= cells.size()) {
    throw SceneError({source_.file, rows_[row].number, rows_[row].text.size() + 1},
                     shortened(names()[column]),
                     fmt::format("cells on this line: {}; allowed: one for each of the {} columns",
                                 cells.size(), names().size()));
  }
  return cells[column];
}

std::vector<double> MeasuredTable::numbers(std::size_t column) const {
  std::vector<double> values(rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (!parse_number(cell(row, column).text, heading_.separator != ',', values[row])) {
      throw error(row, column, "is no number; allowed: a finite number");
    }
  }
  return values;
}

SceneError MeasuredTable::error(std::size_t row, std::size_t column,
                                const std::string& message) const {
  const Cell at = cell(row, column);
  return {{source_.file, rows_[row].number, at.column},
          shortened(names()[column]),
          fmt::format("\"{}\" {}", shortened(at.text), message)};
}

SceneError MeasuredTable::heading_error(const std::string& message) const {
  return {{source_.file, heading_.line, 1}, "heading", message};
}

SceneError MeasuredTable::heading_error(std::size_t column, const std::string& message) const {
  return {{source_.file, heading_.line, heading_.places[column]}, "heading", message};
}

}  // namespace sonoglide::identify
