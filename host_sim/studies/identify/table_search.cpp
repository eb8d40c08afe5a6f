#include "host_sim/studies/identify/table_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
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

/// The one that a heading is split at.
char separator_of(std::string_view heading) {
  for (const char each : {'\t', ';', ','}) {
    if (heading.find(each) != std::string_view::npos) {
      return each;
    }
  }
  return ' ';
}

bool is_numeric_in(std::string_view cell, char separator) {
  return is_numeric(cell, separator != ',');
}

/// The line as a heading: as many cells at least, none of them a number.
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

bool has_brackets(std::string_view text) {
  return text.find_first_of("([") != std::string_view::npos;
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
        return bracketed || unit_of_text(plain_text(each)).has_value();
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

/// Lines of numbers below a heading.
class Rows {
 public:
  Rows(const std::vector<Line>& lines, std::size_t begin, const Heading& heading)
      : lines_(lines), heading_(heading) {
    for (end_ = begin; end_ < lines.size() && trimmed(lines[end_].text) != "END"; ++end_) {
      if (is_comment(lines[end_].text)) {
        continue;
      }
      if (found_.empty()) {
        labelled_ = !begins_with_number(lines[end_]) && is_labelled(lines[end_]);
      }
      if (!is_row(lines[end_])) {
        break;
      }
      found_.push_back(lines[end_]);
    }
  }

  const std::vector<Line>& found() const { return found_; }

  bool fits() const {
    if (found_.empty()) {
      return false;
    }
    const std::vector<Cell> cells = cells_of(found_.front().text, heading_.separator);
    return cells.size() >= heading_.names.size() &&
           std::all_of(cells.begin() + static_cast<std::ptrdiff_t>(heading_.names.size()),
                       cells.end(), [](const Cell& each) { return each.text.empty(); });
  }

  /// The line that ends them, if it is neither `END` nor the end of the text.
  const Line* line_below() const {
    return end_ < lines_.size() && trimmed(lines_[end_].text) != "END" ? &lines_[end_] : nullptr;
  }

  bool has_rows_below() const {
    return std::any_of(lines_.begin() + static_cast<std::ptrdiff_t>(end_), lines_.end(),
                       [&](const Line& each) {
                         return !is_comment(each.text) && is_row(each) &&
                                cells_of(each.text, heading_.separator).size() > 1;
                       });
  }

 private:
  bool begins_with_number(const Line& line) const {
    const std::vector<Cell> cells = cells_of(line.text, heading_.separator);
    const auto first = std::find_if(cells.begin(), cells.end(),
                                    [](const Cell& each) { return !each.text.empty(); });
    return first != cells.end() && is_numeric_in(first->text, heading_.separator);
  }

  /// As many cells as the heading, the first of them a word with a digit, as a time has; one of the
  /// others a number.
  bool is_labelled(const Line& line) const {
    const std::vector<Cell> cells = cells_of(line.text, heading_.separator);
    const std::string_view label = cells.front().text;
    return cells.size() == heading_.names.size() &&
           std::any_of(label.begin(), label.end(),
                       [](unsigned char each) { return std::isdigit(each) != 0; }) &&
           std::any_of(cells.begin() + 1, cells.end(), [&](const Cell& each) {
             return is_numeric_in(each.text, heading_.separator);
           });
  }

  bool is_row(const Line& line) const {
    return labelled_ ? is_labelled(line) : begins_with_number(line);
  }

  const std::vector<Line>& lines_;
  const Heading& heading_;
  std::vector<Line> found_;
  std::size_t end_;
  bool labelled_ = false;
};

struct Candidate {
  Heading heading;
  std::size_t first_row = 0;  ///< its place among the lines
  std::size_t rows = 0;
};

void require_one_table(const scene_file::Source& source, const std::vector<Candidate>& wanted,
                       const Candidate& best) {
  for (const Candidate& each : wanted) {
    // Settings may stand as one row below their names.
    if (each.heading.line != best.heading.line && each.rows > 1) {
      throw SceneError({source.file, std::max(each.heading.line, best.heading.line), 1}, "heading",
                       fmt::format("a second table, beside that of line {}; allowed: one table in "
                                   "a file",
                                   std::min(each.heading.line, best.heading.line)));
    }
  }
}

Candidate find_heading(const scene_file::Source& source, const std::vector<Line>& lines,
                       const IsWanted& is_wanted) {
  std::optional<Candidate> best;
  std::vector<Candidate> all_wanted;
  std::tuple<bool, bool, bool, std::size_t> best_rank;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::optional<Heading> heading = heading_of(lines[i], 2);
    if (!heading) {
      continue;
    }
    if (i + 1 < lines.size()) {
      const auto units = heading_of(lines[i + 1], 1);
      if (units && is_line_of_units(*units, *heading, is_wanted)) {
        join(*heading, *units);
        ++i;
      }
    }
    const bool wanted = is_wanted(heading->names);
    // A remark may stand between the heading and its rows.
    const bool has_remark = wanted && i + 2 < lines.size() &&
                            cells_of(lines[i + 1].text, heading->separator).size() == 1 &&
                            Rows(lines, i + 1, *heading).found().empty();
    const std::size_t first_row = i + (has_remark ? 2 : 1);
    const Rows rows(lines, first_row, *heading);
    const std::tuple rank(!rows.found().empty(), wanted, rows.fits(), rows.found().size());
    if (wanted) {
      all_wanted.push_back({*heading, first_row, rows.found().size()});
    }
    if (!best || rank >= best_rank) {
      best_rank = rank;
      best = Candidate{std::move(*heading), first_row, rows.found().size()};
    }
  }
  if (!best) {
    throw SceneError({source.file, 1, 1}, "heading",
                     "no line names the columns; allowed: a heading of at least two names, as "
                     "frequency_Hz,impedance_magnitude_ohm,impedance_phase_deg");
  }
  require_one_table(source, all_wanted, *best);
  return std::move(*best);
}

}  // namespace

FoundTable find_table(const scene_file::Source& source, const IsWanted& is_wanted) {
  const std::vector<Line> lines = lines_of(source);
  Candidate best = find_heading(source, lines, is_wanted);
  const Rows rows(lines, best.first_row, best.heading);
  FoundTable found{best.heading, rows.found(), {}};
  if (const Line* below = rows.line_below()) {
    if (rows.has_rows_below()) {
      throw SceneError({source.file, below->number, 1}, "row",
                       fmt::format("\"{}\" ends the table, and rows stand below it; allowed: one "
                                   "table in a file, its rows without a break",
                                   shortened(below->text)));
    }
    if (!found.rows.empty()) {
      found.warning = fmt::format("Line {}, \"{}\", stands below the table and is not read.",
                                  below->number, shortened(below->text));
    }
  }
  return found;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t most = 40;
  return std::string(trimmed(text).substr(0, most));
}

}  // namespace sonoglide::identify
