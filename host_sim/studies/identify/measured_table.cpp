#include "host_sim/studies/identify/measured_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <system_error>

namespace sonoglide::identify {
namespace {

using scene_file::SceneError;

constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) {
    return {};
  }
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

[[noreturn]] void refuse(const std::string& file, const std::string& message) {
  throw SceneError({file, 1, 1}, "file", message);
}

void require_text(const std::string& file, std::string_view text) {
  constexpr std::string_view allowed = "allowed: a text file of measurements, ASCII or UTF-8";
  const auto starts_with = [&](std::string_view mark) { return text.substr(0, 2) == mark; };
  if (starts_with("\xff\xfe") || starts_with("\xfe\xff")) {
    refuse(file, fmt::format("is text in UTF-16; {}", allowed));
  }
  const std::size_t zero = text.find('\0');
  if (zero != std::string_view::npos) {
    refuse(file, fmt::format("is no text, byte {} is 0; {}", zero, allowed));
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    refuse(file, fmt::format("is empty; {}", allowed));
  }
}

bool is_comment(std::string_view line) {
  return !line.empty() && (line.front() == '#' || line.front() == '!' || line.front() == '%');
}

/// The one that a heading is split at.
char separator_of(std::string_view heading) {
  for (const char each : {'\t', ';', ','}) {
    if (heading.find(each) != std::string_view::npos) {
      return each;
    }
  }
  return ' ';
}

bool is_numeric(std::string_view cell, bool decimal_comma) {
  double value = 0.0;
  return parse_number(cell, decimal_comma, value) || cell == "nan" || cell == "NaN";
}

std::size_t numeric_cells(const std::vector<Cell>& cells, char separator) {
  return static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), [&](const Cell& each) {
    return is_numeric(each.text, separator != ',');
  }));
}

/// A cell of the line of units as it stands behind a name.
std::string in_brackets(std::string_view unit) {
  return unit.find_first_of("([") == std::string_view::npos ? fmt::format("[{}]", unit)
                                                            : std::string(unit);
}

/// The mark of a number's fraction; 0 where it has none.
char decimal_mark(std::string_view cell) {
  const std::size_t at = cell.find_first_of(".,");
  return at == std::string_view::npos || !is_numeric(cell, true) ? '\0' : cell[at];
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

std::string warning_of_cut(const scene_file::Source& source) {
  const std::string_view last = lines_of(source.text).back();
  const bool ends = source.text.find_last_of("\r\n") + 1 == source.text.size();
  if (ends || trimmed(last) == "END") {
    return {};
  }
  return fmt::format("The last line, \"{}\", has no line end: if the file was cut, it is wrong.",
                     trimmed(last).substr(0, 60));
}

scene_file::Source read_text(const std::filesystem::path& path) {
  const std::string file = path.string();
  constexpr std::string_view allowed = "allowed: a readable file of measurements";
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    refuse(file, fmt::format("is a directory; {}", allowed));
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    refuse(file, fmt::format("{}; {}", std::generic_category().message(errno), allowed));
  }
  std::string text;
  constexpr std::size_t piece = std::size_t{1} << 20U;
  while (stream && text.size() <= most_bytes) {
    const std::size_t size = text.size();
    text.resize(size + piece);
    stream.read(text.data() + size, static_cast<std::streamsize>(piece));
    text.resize(size + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) {
    refuse(file, fmt::format("cannot be read; {}", allowed));
  }
  if (text.size() > most_bytes) {
    refuse(file, fmt::format("is too large; allowed: up to {} MB", most_bytes >> 20U));
  }
  require_text(file, text);
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (text.compare(0, mark.size(), mark) == 0) {
    text.erase(0, mark.size());
  }
  return {file, std::move(text)};
}

bool parse_number(std::string_view cell, bool decimal_comma, double& value) {
  if (!cell.empty() && cell.front() == '+') {
    cell.remove_prefix(1);
  }
  std::string with_point;
  if (decimal_comma && cell.find(',') != std::string_view::npos &&
      cell.find('.') == std::string_view::npos) {
    with_point = cell;
    with_point[cell.find(',')] = '.';
    cell = with_point;
  }
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value);
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    // Instruments of old end their lines with CR alone.
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back(text.substr(0, end));
    const bool both = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(end + (both ? 2 : 1), text.size()));
  }
  return lines;
}

std::vector<Cell> cells_of(std::string_view line, char separator) {
  std::vector<Cell> cells;
  std::size_t at = 0;
  while (true) {
    if (separator == ' ') {
      at = line.find_first_not_of(blanks, at);
      if (at == std::string_view::npos) {
        return cells;
      }
    }
    const std::size_t first = std::min(line.find_first_not_of(" \v\f", at), line.size());
    const bool quoted = first < line.size() && line[first] == '"';
    const std::size_t closing = quoted ? line.find('"', first + 1) : std::string_view::npos;
    const std::size_t from = closing == std::string_view::npos ? at : closing;
    const std::size_t end =
        std::min(separator == ' ' ? line.find_first_of(blanks, from) : line.find(separator, from),
                 line.size());
    std::string_view text = trimmed(line.substr(at, end - at));
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
      text = trimmed(text.substr(1, text.size() - 2));
    }
    cells.push_back({text, std::min(first, end) + 1});
    if (end == line.size()) {
      return cells;
    }
    at = end + 1;
  }
}

MeasuredTable::MeasuredTable(const scene_file::Source& source) : source_(source) {
  const std::vector<std::string_view> lines = lines_of(source.text);
  std::size_t first_row = lines.size();
  find_heading(lines, first_row);
  for (std::size_t i = first_row; i < lines.size(); ++i) {
    const std::string_view line = trimmed(lines[i]);
    if (line == "END") {
      break;
    }
    if (!line.empty() && !is_comment(line)) {
      rows_.push_back({lines[i], i + 1});
    }
  }
  if (rows_.empty()) {
    throw heading_error("no row of numbers below the heading; allowed: at least one");
  }
  require_no_surplus();
  require_one_decimal_mark();
}

void MeasuredTable::require_no_surplus() const {
  for (const Row& row : rows_) {
    const std::vector<Cell> cells = cells_of(row.line, separator_);
    for (std::size_t i = names_.size(); i < cells.size(); ++i) {
      if (!cells[i].text.empty()) {
        throw SceneError(
            {source_.file, row.number, cells[i].column}, "row",
            fmt::format("cells on this line: {}; allowed: one for each of the {} columns{}",
                        cells.size(), names_.size(),
                        separator_ == ',' ? "; numbers with decimal commas need semicolons or tabs "
                                            "between them"
                                          : ""));
      }
    }
  }
}

void MeasuredTable::require_one_decimal_mark() const {
  if (separator_ == ',') {
    return;
  }
  char mark = '\0';
  std::size_t line_of_mark = 0;
  for (const Row& row : rows_) {
    for (const Cell& each : cells_of(row.line, separator_)) {
      const char found = decimal_mark(each.text);
      if (found != '\0' && mark != '\0' && found != mark) {
        throw SceneError(
            {source_.file, row.number, each.column}, "row",
            fmt::format("\"{}\" has a decimal {}, and line {} has decimal {}; allowed: "
                        "one of them in a file, and nothing between thousands",
                        each.text.substr(0, 40), found == ',' ? "comma" : "point", line_of_mark,
                        mark == ',' ? "commas" : "points"));
      }
      if (found != '\0' && mark == '\0') {
        mark = found;
        line_of_mark = row.number;
      }
    }
  }
}

/// Whether the line is a heading: at least two cells, all of words; joined to the one above, if that
/// is of as many words.
bool MeasuredTable::take_heading(std::string_view line, std::size_t number) {
  const char separator = separator_of(line);
  const std::vector<Cell> cells = cells_of(line, separator);
  if (cells.size() < 2 || numeric_cells(cells, separator) != 0) {
    return false;
  }
  const bool units =
      names_.size() == cells.size() && separator == separator_ && number == heading_line_ + 1;
  if (!units) {
    names_.assign(cells.size(), "");
    heading_line_ = number;
    separator_ = separator;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    names_[i] += !units                  ? std::string(cells[i].text)
                 : cells[i].text.empty() ? std::string()
                                         : " " + in_brackets(cells[i].text);
  }
  return true;
}

void MeasuredTable::find_heading(const std::vector<std::string_view>& lines,
                                 std::size_t& first_row) {
  std::size_t last_comment = lines.size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = trimmed(lines[i]);
    if (line.empty()) {
      continue;
    }
    if (is_comment(line)) {
      last_comment = i;
      continue;
    }
    const char separator = names_.empty() ? separator_of(line) : separator_;
    const std::vector<Cell> cells = cells_of(lines[i], separator);
    const bool begins_with_number = is_numeric(cells.front().text, separator != ',');
    const bool like_heading = cells.size() == names_.size() && numeric_cells(cells, separator) > 0;
    if (cells.size() >= 2 && (begins_with_number || like_heading)) {
      first_row = i;
      break;
    }
    take_heading(lines[i], i + 1);
  }
  if (names_.empty() && last_comment < first_row) {
    take_heading(trimmed(lines[last_comment]).substr(1), last_comment + 1);
  }
  if (names_.empty()) {
    throw SceneError({source_.file, 1, 1}, "heading",
                     "no line names the columns; allowed: a heading of at least two names, as "
                     "frequency_Hz,impedance_magnitude_ohm,impedance_phase_deg");
  }
}

Cell MeasuredTable::cell(std::size_t row, std::size_t column) const {
  const std::vector<Cell> cells = cells_of(rows_[row].line, separator_);
  if (column >= cells.size()) {
    throw SceneError({source_.file, rows_[row].number, rows_[row].line.size() + 1}, names_[column],
                     fmt::format("cells on this line: {}; allowed: one for each of the {} columns",
                                 cells.size(), names_.size()));
  }
  return cells[column];
}

std::string_view MeasuredTable::text(std::size_t row, std::size_t column) const {
  return cell(row, column).text;
}

std::vector<double> MeasuredTable::numbers(std::size_t column) const {
  std::vector<double> values(rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (!parse_number(cell(row, column).text, separator_ != ',', values[row])) {
      throw error(row, column, "is no number; allowed: a finite number");
    }
  }
  return values;
}

SceneError MeasuredTable::error(std::size_t row, std::size_t column,
                                const std::string& message) const {
  const Cell at = cell(row, column);
  return {{source_.file, rows_[row].number, at.column},
          names_[column],
          fmt::format("\"{}\" {}", at.text.substr(0, 40), message)};
}

SceneError MeasuredTable::heading_error(const std::string& message) const {
  return {{source_.file, heading_line_, 1}, "heading", message};
}

}  // namespace sonoglide::identify
