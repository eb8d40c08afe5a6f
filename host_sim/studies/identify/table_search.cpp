#include "host_sim/studies/identify/table_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/studies/identify/cell.hpp"
#include "host_sim/studies/identify/plain_text.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify {
namespace {

using scene_file::SceneError;

/// The one that a heading is split at: the first that no quotes enclose.
char separator_of(std::string_view heading) {
  const auto opens = [](const Cell& cell) { return cell.text.substr(0, 1) == "\""; };
  for (const char each : {'\t', ';', ','}) {
    const std::vector<Cell> cells = cells_of(heading, each);
    if (cells.size() > 1 && std::none_of(cells.begin(), cells.end(), opens)) {
      return each;
    }
  }
  return ' ';
}

bool is_numeric_in(std::string_view cell, char separator) {
  return is_numeric(cell, separator != ',');
}

bool has_brackets(std::string_view text) {
  return text.find_first_of("([") != std::string_view::npos;
}

bool is_unit(const std::string& name) {
  return unit_of_text(plain_text(name)).has_value();
}

/// Whether a line of words below a heading has its units.
bool is_line_of_units(const Heading& units, const Heading& heading, const IsWanted& is_wanted) {
  if (units.names.size() > heading.names.size() || units.separator != heading.separator ||
      units.line != heading.line + 1) {
    return false;
  }
  const bool has_unit =
      std::any_of(units.names.begin(), units.names.end(), [](const std::string& each) {
        const bool bracketed = !each.empty() && has_brackets(each.substr(0, 1));
        return bracketed || is_unit(each);
      });
  return has_unit || (is_wanted(heading.names) && !is_wanted(units.names));
}

void join(Heading& heading, const Heading& units) {
  for (std::size_t i = 0; i < units.names.size(); ++i) {
    const std::string& unit = units.names[i];
    if (!unit.empty()) {
      heading.names[i] += has_brackets(unit) ? " " + unit : fmt::format(" [{}]", unit);
    }
  }
}

bool begins_with_number(const Line& line, const Heading& heading) {
  const std::vector<Cell> cells = cells_of(line.text, heading.separator);
  const auto first =
      std::find_if(cells.begin(), cells.end(), [](const Cell& each) { return !each.text.empty(); });
  return first != cells.end() && is_numeric_in(first->text, heading.separator);
}

/// As many cells as the heading, the first of them a word with a digit, as a time has; one of the
/// others a number.
bool is_labelled(const Line& line, const Heading& heading) {
  const std::vector<Cell> cells = cells_of(line.text, heading.separator);
  return cells.size() == heading.names.size() &&
         cells.front().text.find_first_of("0123456789") != std::string_view::npos &&
         std::any_of(cells.begin() + 1, cells.end(),
                     [&](const Cell& each) { return is_numeric_in(each.text, heading.separator); });
}

/// Lines of numbers below a heading, without the comments between them.
struct Rows {
  std::size_t begin = 0;  ///< among the lines
  char separator = 0;
  std::size_t columns = 0;
  std::vector<Line> found = {};
  std::size_t end = 0;
  bool (*is_row)(const Line&, const Heading&) = begins_with_number;
};

struct Table {
  Heading heading;
  std::shared_ptr<const Rows> rows;
  bool wanted = false;

  /// The one of the largest is read.
  auto rank() const {
    return std::make_tuple(!rows->found.empty(), wanted, fits(), rows->found.size());
  }

 private:
  bool fits() const {
    if (rows->found.empty()) {
      return false;
    }
    const std::vector<Cell> cells = cells_of(rows->found.front().text, heading.separator);
    const std::size_t columns = heading.names.size();
    return cells.size() >= columns &&
           std::all_of(cells.begin() + static_cast<std::ptrdiff_t>(columns), cells.end(),
                       [](const Cell& each) { return each.text.empty(); });
  }
};

class TableSearch {
 public:
  TableSearch(const scene_file::Source& source, const IsWanted& is_wanted)
      : source_(source), is_wanted_(is_wanted), lines_(lines_of(source)) {
    content_.assign(lines_.size() + 2, lines_.size());
    for (std::size_t i = lines_.size(); i-- > 0;) {
      content_[i] = is_comment(lines_[i].text) ? content_[i + 1] : i;
    }
  }

  FoundTable find() {
    std::optional<Table> best;
    std::vector<std::size_t> tables;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      std::optional<Table> table = table_at(i);
      // Settings may stand as one row below their names.
      if (table && table->wanted && table->rows->found.size() > 1) {
        tables.push_back(table->heading.line);
      }
      if (table && (!best || table->rank() >= best->rank())) {
        best = std::move(table);
      }
    }
    if (!best) {
      throw error(1, "heading",
                  "no line names the columns; allowed: a heading of at least two names, as "
                  "frequency_Hz,impedance_magnitude_ohm,impedance_phase_deg");
    }
    for (const std::size_t each : tables) {
      const auto [first, second] = std::minmax(each, best->heading.line);
      if (first != second) {
        throw error(second, "heading",
                    fmt::format("a second table, beside that of line {}; allowed: one table in a "
                                "file",
                                first));
      }
    }
    return {best->heading, best->rows->found, warning_of_rest(*best)};
  }

 private:
  /// That of the heading at a line, which passes over the line of its units.
  std::optional<Table> table_at(std::size_t& line) {
    std::optional<Heading> heading = heading_of(lines_[line], 2);
    if (!heading) {
      return std::nullopt;
    }
    const bool rows_follow = begins_rows(line + 1, *heading);
    const bool rows_are_near = begins_rows(line + 2, *heading);
    const auto below = rows_are_near ? heading_of(lines_[line + 1], 1) : std::nullopt;
    std::size_t begin = line + 1;
    if (below && is_line_of_units(*below, *heading, is_wanted_)) {
      join(*heading, *below);
      begin = ++line + 1;
    }
    // Seldom they stand above it.
    const auto above = line > 0 && rows_follow ? heading_of(lines_[line - 1], 2) : std::nullopt;
    if (above && above->line + 1 == heading->line && above->separator == heading->separator &&
        above->names.size() == heading->names.size() &&
        std::all_of(above->names.begin(), above->names.end(), is_unit)) {
      join(*heading, *above);
    }
    const bool wanted = (rows_follow || rows_are_near) && is_wanted_(heading->names);
    // A remark may stand between the heading and its rows.
    if (wanted && !begins_rows(begin, *heading) &&
        cells_of(lines_[begin].text, heading->separator).size() == 1) {
      ++begin;
    }
    return Table{*heading, rows_from(begin, *heading), wanted};
  }

  bool begins_rows(std::size_t at, const Heading& heading) const {
    const std::size_t first = at < lines_.size() ? content_[at] : lines_.size();
    return first < lines_.size() &&
           (begins_with_number(lines_[first], heading) || is_labelled(lines_[first], heading));
  }

  std::shared_ptr<const Rows> rows_from(std::size_t at, const Heading& heading) {
    const std::size_t columns = heading.names.size();
    const std::size_t begin = content_[at];
    if (rows_ && rows_->begin == begin && rows_->separator == heading.separator &&
        rows_->columns == columns) {
      return rows_;  // Of many comments above them each may be the heading.
    }
    Rows rows{begin, heading.separator, columns};
    if (begin < lines_.size() && !begins_with_number(lines_[begin], heading)) {
      rows.is_row = is_labelled;
    }
    for (rows.end = begin; rows.end < lines_.size(); rows.end = content_[rows.end + 1]) {
      const Line& line = lines_[rows.end];
      if (trimmed(line.text) == "END" || !rows.is_row(line, heading)) {
        break;
      }
      rows.found.push_back(line);
    }
    return rows_ = std::make_shared<const Rows>(std::move(rows));
  }

  /// Of the lines below the rows, if they do not begin with `END`.
  std::string warning_of_rest(const Table& table) const {
    const Rows& rows = *table.rows;
    if (rows.found.empty() || rows.end == lines_.size() ||
        trimmed(lines_[rows.end].text) == "END") {
      return {};
    }
    const Line& below = lines_[rows.end];
    const bool has_rows =
        std::any_of(lines_.begin() + static_cast<std::ptrdiff_t>(rows.end), lines_.end(),
                    [&](const Line& each) {
                      return !is_comment(each.text) && rows.is_row(each, table.heading) &&
                             cells_of(each.text, table.heading.separator).size() > 1;
                    });
    if (has_rows) {
      throw error(below.number, "row",
                  fmt::format("\"{}\" ends the table, and rows stand below it; allowed: one "
                              "table in a file, its rows without a break",
                              shortened(below.text)));
    }
    return fmt::format("Line {}, \"{}\", stands below the table and is not read.", below.number,
                       shortened(below.text));
  }

  SceneError error(std::size_t line, const char* key, const std::string& message) const {
    return {{source_.file, line, 1}, key, message};
  }

  const scene_file::Source& source_;
  const IsWanted& is_wanted_;
  std::vector<Line> lines_;
  std::vector<std::size_t> content_;  ///< of each line, the next that is no comment
  std::shared_ptr<const Rows> rows_;  ///< the last
};

}  // namespace

std::optional<Heading> heading_of(const Line& line, std::size_t least_cells) {
  std::string_view text = line.text;
  if (is_comment(text)) {
    text.remove_prefix(text.find_first_of("#!%") + 1);
  }
  Heading heading;
  heading.line = line.number;
  heading.separator = separator_of(text);
  std::vector<Cell> cells = cells_of(text, heading.separator);
  while (!cells.empty() && cells.back().text.empty()) {
    cells.pop_back();
  }
  if (cells.size() < least_cells || cells.size() > most_cells ||
      std::any_of(cells.begin(), cells.end(),
                  [&](const Cell& each) { return is_numeric_in(each.text, heading.separator); })) {
    return std::nullopt;
  }
  for (const Cell& each : cells) {
    heading.names.emplace_back(each.text);
    heading.places.push_back(each.column + (line.text.size() - text.size()));
  }
  return heading;
}

FoundTable find_table(const scene_file::Source& source, const IsWanted& is_wanted) {
  return TableSearch(source, is_wanted).find();
}

std::string shortened(std::string_view text) {
  constexpr std::size_t most = 40;
  return std::string(trimmed(text).substr(0, most));
}

}  // namespace sonoglide::identify
