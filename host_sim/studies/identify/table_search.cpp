#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "host_sim/studies/identify/measured_table.hpp"
#include "host_sim/studies/identify/text_file.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify {
namespace {

using scene_file::SceneError;
using Cells = std::vector<Cell>;
using Names = std::vector<std::string>;

bool is_blank(const Cell& cell) {
  return cell.text.empty();
}

bool is_unit(const std::string& name) {
  return unit_of_text(plain_text(name)).has_value();
}

bool is_unit_or_in_brackets(const std::string& name) {
  return name.substr(0, 1) == "(" || name.substr(0, 1) == "[" || is_unit(name);
}

/// The one that a heading is split at: the first that no quotes enclose.
char separator_of(std::string_view heading) {
  const auto opens = [](const Cell& cell) { return cell.text.substr(0, 1) == "\""; };
  for (const char each : {'\t', ';', ','}) {
    const Cells cells = cells_of(heading, each);
    if (cells.size() > 1 && std::none_of(cells.begin(), cells.end(), opens)) {
      return each;
    }
  }
  return ' ';
}

/// Lines that begin with a number or, if the first of them does not, with a label.
struct Rows {
  char separator = ',';
  std::size_t columns = 0;  ///< of the heading
  bool labelled = false;
  std::size_t begin = 0;  ///< among the lines, with comments between them
  std::size_t end = 0;
  std::size_t count = 0;

  bool has(const Line& line) const {
    const Cells cells = cells_of(line.text, separator);
    const auto is_number = [&](const Cell& each) { return is_numeric(each.text, separator); };
    if (labelled) {  // A word with a digit, as a time, and a number behind it.
      return cells.size() == columns &&
             cells.front().text.find_first_of("0123456789") != std::string_view::npos &&
             std::any_of(cells.begin() + 1, cells.end(), is_number);
    }
    const auto first = std::find_if_not(cells.begin(), cells.end(), is_blank);
    return first != cells.end() && is_number(*first);
  }
};

struct Table {
  Heading heading;
  Rows rows;
  bool wanted = false;  ///< and has rows
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
    Table best;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      Table table = table_at(i);
      // Settings may stand as one row below their names.
      if (best.wanted && best.rows.count > 1 && table.wanted && table.rows.count > 1) {
        throw error(table.heading.line, "heading",
                    fmt::format("a second table, beside that of line {}; allowed: one table in a "
                                "file",
                                best.heading.line));
      }
      if (!table.heading.names.empty() &&
          std::tie(table.wanted, table.rows.count) >= std::tie(best.wanted, best.rows.count)) {
        best = std::move(table);
      }
    }
    if (best.heading.names.empty()) {
      throw error(1, "heading",
                  "no line names the columns; allowed: a heading of at least two names, as "
                  "frequency_Hz,impedance_magnitude_ohm,impedance_phase_deg");
    }
    FoundTable found;
    warn_of_rest(best.rows, found.warnings);
    for (std::size_t i = best.rows.begin; i < best.rows.end; i = content_[i + 1]) {
      found.rows.push_back(lines_[i]);
    }
    found.heading = std::move(best.heading);
    return found;
  }

 private:
  /// That of the heading at a line, which passes over the line of its units; else one without names.
  Table table_at(std::size_t& line) {
    Table table;
    table.heading = heading_of(lines_[line], 2);
    if (table.heading.names.empty()) {
      return table;
    }
    const Rows form{table.heading.separator, table.heading.names.size()};
    table.rows = rows_from(content_[line + 1], form);
    const bool is_above_rows = table.rows.begin == line + 1 && table.rows.count > 0;
    const Rows below = is_above_rows ? Rows() : rows_from(content_[line + 2], form);
    const auto is_remark = [&] {
      return table.rows.count == 0 && cells_of(lines_[line + 1].text, form.separator).size() == 1;
    };
    if (below.count > 0 && (join_units(line + 1, table.heading) || is_remark())) {
      table.rows = below;
      ++line;
    } else if (table.rows.count > 0 && line > 0) {
      join_units(line - 1, table.heading);
    }
    table.wanted = table.rows.count > 0 && is_wanted_(table.heading.names);
    return table;
  }

  /// Joins the units on a line below the heading, or seldom above it, to its names.
  /// @return there are some
  bool join_units(std::size_t at, Heading& heading) const {
    const Heading units = heading_of(lines_[at], 1);
    const Names& names = units.names;
    if (names.empty() || units.separator != heading.separator ||
        names.size() > heading.names.size()) {
      return false;
    }
    const bool above = units.line + 1 == heading.line && names.size() == heading.names.size() &&
                       std::all_of(names.begin(), names.end(), is_unit);
    const bool below = units.line == heading.line + 1 &&
                       (std::any_of(names.begin(), names.end(), is_unit_or_in_brackets) ||
                        (is_wanted_(heading.names) && !is_wanted_(names)));
    for (std::size_t i = 0; (above || below) && i < names.size(); ++i) {
      const bool has_brackets = names[i].find_first_of("([") != std::string::npos;
      heading.names[i] += names[i].empty() ? ""
                          : has_brackets   ? " " + names[i]
                                           : fmt::format(" [{}]", names[i]);
    }
    return above || below;
  }

  Rows rows_from(std::size_t begin, Rows rows) {
    if (last_.begin == begin && last_.separator == rows.separator &&
        last_.columns == rows.columns) {
      return last_;  // Of many comments above them each may be the heading.
    }
    rows.begin = begin;
    rows.labelled = begin < lines_.size() && !rows.has(lines_[begin]);
    for (rows.end = begin; rows.end < lines_.size(); rows.end = content_[rows.end + 1]) {
      if (trimmed(lines_[rows.end].text) == "END" || !rows.has(lines_[rows.end])) {
        break;
      }
      ++rows.count;
    }
    last_ = rows.count > 0 ? rows : last_;
    return rows;
  }

  /// Of the lines below the rows; `END` alone is what instruments end a file with.
  void warn_of_rest(const Rows& rows, std::vector<std::string>& warnings) const {
    if (rows.count == 0 || rows.end == lines_.size()) {
      return;
    }
    const Line& below = lines_[rows.end];
    const auto is_row = [&](const Line& each) {
      return !is_comment(each.text) && rows.has(each) &&
             cells_of(each.text, rows.separator).size() > 1;
    };
    if (std::any_of(lines_.begin() + static_cast<std::ptrdiff_t>(rows.end), lines_.end(), is_row)) {
      throw error(below.number, "row",
                  fmt::format("\"{}\" ends the table, and rows follow it; allowed: one "
                              "table in a file, its rows without a break",
                              shortened(below.text)));
    }
    if (trimmed(below.text) == "END") {
      return;
    }
    warnings.push_back(fmt::format("Line {}, \"{}\", is below the table and is not read.",
                                   below.number, shortened(below.text)));
  }

  SceneError error(std::size_t line, const char* key, const std::string& message) const {
    return {{source_.file, line, 1}, key, message};
  }

  const scene_file::Source& source_;
  const IsWanted& is_wanted_;
  std::vector<Line> lines_;
  std::vector<std::size_t> content_;  ///< of each line, the next that is no comment
  Rows last_;
};

}  // namespace

Heading heading_of(const Line& line, std::size_t least_cells) {
  std::string_view text = line.text;
  if (is_comment(text)) {
    text.remove_prefix(text.find_first_of("#!%") + 1);
  }
  Heading heading;
  heading.line = line.number;
  heading.separator = separator_of(text);
  Cells cells = cells_of(text, heading.separator);
  while (!cells.empty() && is_blank(cells.back())) {
    cells.pop_back();
  }
  if (cells.size() < least_cells || cells.size() > most_cells ||
      std::any_of(cells.begin(), cells.end(),
                  [&](const Cell& each) { return is_numeric(each.text, heading.separator); })) {
    return {};
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

}  // namespace sonoglide::identify
