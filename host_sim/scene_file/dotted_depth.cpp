#include "host_sim/scene_file/dotted_depth.hpp"

#include <algorithm>

namespace sonoglide::scene_file {
namespace {

bool joins_names(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == ' ' || c == '\t' || static_cast<unsigned char>(c) >= 0x80;
}

/// Offset just past the string that opens at `begin`; a broken one ends with its line or the text.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string_view triple = quote == '"' ? "\"\"\"" : "'''";
  const bool multi_line = text.substr(begin, 3) == triple;
  std::size_t i = begin + (multi_line ? 3 : 1);
  while (i < text.size()) {
    if (text[i] == '\\' && quote == '"') {
      i += 2;
    } else if (multi_line && text.substr(i, 3) == triple) {
      return i + 3;
    } else if (!multi_line && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else {
      ++i;
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> find_excess_dot(std::string_view text) {
  int dots = 0;
  std::size_t i = 0;
  while (i < text.size()) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      dots = 0;
      continue;
    }
    if (c == '.' && ++dots > max_dots) {
      return i;
    }
    if (c != '.' && !joins_names(c)) {
      dots = 0;
    }
    ++i;
  }
  return std::nullopt;
}

}  // namespace sonoglide::scene_file
