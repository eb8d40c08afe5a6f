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

/// The mark of the fractions in a file.
class DecimalMark {
 public:
  void take(std::string_view cell, const scene_file::Location& place) {
    const std::size_t at = cell.find_first_of(".,");
    if (at == std::string_view::npos || !is_numeric(cell, true)) {
      return;
    }
    if (cell_.empty()) {
      cell_ = cell;
      mark_ = cell[at];
      line_ = place.line;
    } else if (cell[at] != mark_) {
      throw SceneError(place, "row",
                       fmt::format("\"{}\" has a decimal {}, and line {} has decimal {}; allowed: "
                                   "one of them in a file, and nothing between thousands",
                                   shortened(cell), cell[at] == ',' ? "comma" : "point", line_,
                                   mark_ == ',' ? "commas" : "points"));
    }
    // As 28,000: three digits behind it, and up to three before it.
    constexpr std::size_t group = 3;
    const std::size_t first = cell.find_first_of("0123456789");
    thousands_ = thousands_ && mark_ == ',' && at - first <= group && cell[first] != '0' &&
                 cell.find_first_not_of("0123456789", at + 1) == std::string_view::npos &&
                 cell.size() == at + 1 + group;
  }

  std::string warning() const {
    return cell_.empty() || !thousands_
               ? std::string()
               : fmt::format(
                     "The commas of numbers as \"{}\" on line {} are taken for decimal "
                     "commas; where they stand between thousands, take them out.",
                     shortened(cell_), line_);
  }

 private:
  std::string_view cell_;  ///< the first that has one
  char mark_ = 0;
  std::size_t line_ = 0;
  bool thousands_ = true;
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
  DecimalMark mark;
  for (const Line& row : rows_) {
    const std::vector<Cell> cells = cells_of(row.text, heading_.separator);
    scene_file::Location place{source_.file, row.number, 1};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      place.column = cells[i].column;
      if (i >= names().size() && (!cells[i].text.empty() || i == most_cells)) {
        throw SceneError(
            place, "row",
            fmt::format("cells on this line: {}; allowed: one for each of the {} columns{}",
                        counted(cells), names().size(),
                        heading_.separator == ','
                            ? "; numbers with decimal commas need semicolons or tabs between them"
                            : ""));
      }
      if (heading_.separator != ',') {
        mark.take(cells[i].text, place);
      }
    }
  }
  if (const std::string warning = mark.warning(); !warning.empty()) {
    warnings_.push_back(warning);
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
