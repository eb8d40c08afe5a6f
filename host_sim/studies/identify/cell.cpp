#include "host_sim/studies/identify/cell.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>

#include "host_sim/studies/identify/plain_text.hpp"

namespace sonoglide::identify {
namespace {

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char each) { return each < 0x80U; });
}

bool is_digit_at(std::string_view text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

/// Without the spaces beyond ASCII that stand between groups of three digits.
std::string without_groups(std::string_view cell) {
  constexpr std::size_t group = 3;
  std::string text;
  for (std::size_t at = 0; at < cell.size();) {
    const std::size_t blank = blank_at(cell, at);
    bool between = blank > 1 && !text.empty() && is_digit_at(text, text.size() - 1);
    for (std::size_t i = 0; between && i < group; ++i) {
      between = is_digit_at(cell, at + blank + i);
    }
    if (between && !is_digit_at(cell, at + blank + group)) {
      at += blank;
    } else {
      text += cell[at++];
    }
  }
  return text;
}

/// The first place from `at` on where a blank is, or is none.
std::size_t find_blank(std::string_view line, std::size_t at, bool wanted) {
  while (at < line.size()) {
    const std::size_t blank = blank_at(line, at);
    if ((blank > 0) == wanted) {
      break;
    }
    at += std::max<std::size_t>(blank, 1);
  }
  return at;
}

}  // namespace

std::vector<Cell> cells_of(std::string_view line, char separator) {
  std::vector<Cell> cells;
  std::size_t at = 0;
  while (cells.size() <= most_cells) {
    if (separator == ' ') {
      at = find_blank(line, at, false);
      if (at == line.size()) {
        return cells;
      }
    }
    const std::size_t first = std::min(line.find_first_not_of(" \v\f", at), line.size());
    const bool quoted = first < line.size() && line[first] == '"';
    const std::size_t closing = quoted ? line.find('"', first + 1) : std::string_view::npos;
    const std::size_t from = closing == std::string_view::npos ? at : closing;
    const std::size_t end = separator == ' ' ? find_blank(line, from, true)
                                             : std::min(line.find(separator, from), line.size());
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
  return cells;
}

bool parse_number(std::string_view cell, bool decimal_comma, double& value) {
  std::string changed;
  if (!is_ascii(cell)) {
    changed = plain_text(without_groups(cell));
    cell = changed;
  }
  if (!cell.empty() && cell.front() == '+') {
    cell.remove_prefix(1);
  }
  if (decimal_comma && cell.find(',') != std::string_view::npos &&
      cell.find('.') == std::string_view::npos) {
    std::string with_point(cell);
    with_point[cell.find(',')] = '.';
    changed = std::move(with_point);
    cell = changed;
  }
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value);
}

bool is_numeric(std::string_view cell, bool decimal_comma) {
  double value = 0.0;
  return parse_number(cell, decimal_comma, value) || cell == "nan" || cell == "NaN";
}

}  // namespace sonoglide::identify
