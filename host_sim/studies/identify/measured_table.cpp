#include "host_sim/studies/identify/measured_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host_sim/studies/identify/text_file.hpp"

namespace sonoglide::identify {
namespace {

using scene_file::SceneError;

/// The decimal mark of a table.
class DecimalMark {
 public:
  /// @throws SceneError  the number has another mark than those before it
  void take(const Cell& cell, const scene_file::Location& place) {
    const std::string_view text = cell.text;
    const std::size_t at = text.find_first_of(".,");
    if (at == std::string_view::npos || !number_of(text)) {
      return;
    }
    const char mark = text[at];
    if (first_.empty()) {
      first_ = text;
      mark_ = mark;
      line_ = place.line;
    } else if (mark != mark_) {
      throw SceneError(place, "row",
                       fmt::format("\"{}\" has a decimal {}, and line {} has decimal {}; allowed: "
                                   "one of them in a file, and nothing between thousands",
                                   shortened(text), mark == ',' ? "comma" : "point", line_,
                                   mark == ',' ? "points" : "commas"));
    }
    // As 28,000: three digits behind it, and up to three before it.
    const std::size_t digits = text.find_first_of("0123456789");
    thousands_ = thousands_ && mark == ',' && at <= digits + 3 && text[digits] != '0' &&
                 text.find_first_not_of("0123456789", at + 1) == std::string_view::npos &&
                 text.size() == at + 4;
  }

  void warn(std::vector<std::string>& warnings) const {
    if (!first_.empty() && thousands_) {
      warnings.push_back(fmt::format(
          "The commas of numbers as \"{}\" on line {} are taken for decimal commas; where they "
          "stand between thousands, take them out.",
          shortened(first_), line_));
    }
  }

 private:
  std::string_view first_;  ///< number that has one
  char mark_ = 0;
  std::size_t line_ = 0;
  bool thousands_ = true;  ///< all of them may stand between thousands
};

}  // namespace

std::string unit_in_brackets(const std::string& name) {
  const std::size_t open = name.find_last_of("([");
  if (open == std::string::npos) {
    return {};
  }
  const std::size_t close = name.find_first_of(")]", open);
  return name.substr(open + 1, close == std::string::npos ? close : close - open - 1);
}

MeasuredTable::MeasuredTable(const scene_file::Source& source, FoundTable found)
    : source_(source), found_(std::move(found)) {
  if (found_.rows.empty()) {
    throw heading_error("no row of numbers below the heading; allowed: at least one");
  }
  DecimalMark mark;
  for (const Line& row : found_.rows) {
    const std::vector<Cell> cells = cells_of(row.text, found_.heading.separator);
    scene_file::Location place{source_.file, row.number, 1};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      place.column = cells[i].column;
      if (i >= names().size() && (!cells[i].text.empty() || i == most_cells)) {
        throw SceneError(place, "row",
                         number_of_cells(cells.size()) +
                             (found_.heading.separator == ','
                                  ? "; numbers with decimal commas need semicolons or tabs "
                                    "between them"
                                  : ""));
      }
      if (found_.heading.separator != ',') {
        mark.take(cells[i], place);
      }
    }
  }
  mark.warn(found_.warnings);
  if (const std::string cut = warning_of_cut(source); !cut.empty()) {
    found_.warnings.push_back(cut);
  }
}

std::string MeasuredTable::number_of_cells(std::size_t found) const {
  return fmt::format("cells on this line: {}{}; allowed: one for each of the {} columns",
                     found > most_cells ? "more than " : "", std::min(found, most_cells),
                     names().size());
}

Cell MeasuredTable::cell(std::size_t row, std::size_t column) const {
  const std::vector<Cell> cells = cells_of(found_.rows[row].text, found_.heading.separator);
  if (column >= cells.size()) {
    throw SceneError({source_.file, found_.rows[row].number, found_.rows[row].text.size() + 1},
                     shortened(names()[column]), number_of_cells(cells.size()));
  }
  return cells[column];
}

std::vector<double> MeasuredTable::numbers(std::size_t column) const {
  std::vector<double> values(found_.rows.size());
  for (std::size_t row = 0; row < found_.rows.size(); ++row) {
    const auto number = number_of(cell(row, column).text, found_.heading.separator);
    if (!number) {
      throw error(row, column,
                  "is no number; allowed: a finite number, or # at the beginning of a line "
                  "that is not read");
    }
    values[row] = *number;
  }
  return values;
}

SceneError MeasuredTable::error(std::size_t row, std::size_t column,
                                const std::string& message) const {
  const Cell at = cell(row, column);
  return {{source_.file, found_.rows[row].number, at.column},
          shortened(names()[column]),
          fmt::format("\"{}\" {}", shortened(at.text), message)};
}

SceneError MeasuredTable::heading_error(const std::string& message) const {
  return {{source_.file, found_.heading.line, 1}, "heading", message};
}

SceneError MeasuredTable::heading_error(std::size_t column, const std::string& message) const {
  return {{source_.file, found_.heading.line, found_.heading.places[column]}, "heading", message};
}

}  // namespace sonoglide::identify
