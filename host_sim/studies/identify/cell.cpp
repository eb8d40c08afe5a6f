#include "host_sim/studies/identify/cell.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "host_sim/studies/identify/plain_text.hpp"

namespace sonoglide::identify {
namespace {

/// In ASCII, without the spaces that part groups of three digits.
std::string plain_number(std::string_view cell) {
  constexpr std::string_view digits = "0123456789";
  constexpr std::size_t group = 3;
  std::string text(trimmed(plain_text(cell)));
  for (std::size_t at = text.find(' '); at != std::string::npos; at = text.find(' ', at)) {
    const std::size_t end = std::min(text.find_first_not_of(digits, at + 1), text.size());
    if (end != at + 1 + group || digits.find(text[at - 1]) == std::string_view::npos) {
      break;
    }
    text.erase(at, 1);
  }
  return text;
}

}  // namespace

std::vector<Cell> cells_of(std::string_view line, char separator) {
  const bool by_blanks = separator == ' ';
  const std::string_view blanks = by_blanks ? " \t\r\v\f" : " \v\f";
  const std::string_view ends = by_blanks ? blanks : std::string_view(&separator, 1);
  std::vector<Cell> cells;
  std::size_t at = 0;
  while (cells.size() <= most_cells) {
    const std::size_t first = std::min(line.find_first_not_of(blanks, at), line.size());
    if (by_blanks && first == line.size()) {
      break;
    }
    const bool quoted = line.substr(first, 1) == "\"";
    const std::size_t closing = quoted ? line.find('"', first + 1) : std::string_view::npos;
    const std::size_t from = closing == std::string_view::npos ? first : closing;
    const std::size_t end = std::min(line.find_first_of(ends, from), line.size());
    std::string_view text = trimmed(line.substr(first, end - first));
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
      text = trimmed(text.substr(1, text.size() - 2));
    }
    cells.push_back({text, first + 1});
    if (end == line.size()) {
      break;
    }
    at = end + 1;
  }
  return cells;
}

std::optional<double> number_of(std::string_view cell, char separator) {
  std::string changed;
  if (std::any_of(cell.begin(), cell.end(), [](unsigned char each) { return each >= 0x80U; })) {
    changed = plain_number(cell);
    cell = changed;
  }
  if (!cell.empty() && cell.front() == '+') {
    cell.remove_prefix(1);
  }
  const std::size_t comma = cell.find(',');
  if (separator != ',' && comma != std::string_view::npos &&
      cell.find('.') == std::string_view::npos) {
    changed = cell;
    changed[comma] = '.';
    cell = changed;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_whole = error == std::errc() && end == cell.data() + cell.size();
  return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool is_numeric(std::string_view cell, char separator) {
  return number_of(cell, separator) || cell == "nan" || cell == "NaN";
}

}  // namespace sonoglide::identify
