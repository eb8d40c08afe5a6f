#include "host_sim/studies/identify/text_file.hpp"

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

[[noreturn]] void refuse(const std::string& file, std::string_view message) {
  throw SceneError(
      {file, 1, 1}, "file",
      fmt::format("{}; allowed: a text file of measurements, ASCII, UTF-8 or UTF-16, up to {} MB",
                  message, most_bytes >> 20U));
}

std::string bytes_of(std::istream& stream) {
  constexpr std::size_t piece = std::size_t{1} << 20U;
  std::string bytes;
  while (stream && bytes.size() <= most_bytes) {
    const std::size_t size = bytes.size();
    bytes.resize(size + piece);
    stream.read(bytes.data() + size, static_cast<std::streamsize>(piece));
    bytes.resize(size + static_cast<std::size_t>(stream.gcount()));
  }
  return bytes;
}

/// UTF-8 of text in UTF-16 behind its byte order mark. Signs beyond U+FFFF stay two halves.
std::string of_utf_16(std::string_view bytes) {
  const std::size_t high = bytes.front() == '\xfe' ? 0 : 1;
  std::string text;
  for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[i + at]); };
    const unsigned code = (unsigned{byte(high)} << 8U) + byte(1 - high);
    if (code < 0x80U) {
      text += static_cast<char>(code);
      continue;
    }
    text += static_cast<char>(code < 0x800U ? 0xc0U | (code >> 6U) : 0xe0U | (code >> 12U));
    if (code >= 0x800U) {
      text += static_cast<char>(0x80U | ((code >> 6U) & 0x3fU));
    }
    text += static_cast<char>(0x80U | (code & 0x3fU));
  }
  return text;
}

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

scene_file::Source read_text(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    refuse(file, "is a directory");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    refuse(file, std::generic_category().message(errno));
  }
  std::string text = bytes_of(stream);
  if (stream.bad()) {
    refuse(file, "cannot be read");
  }
  if (text.size() > most_bytes) {
    refuse(file, "is too large");
  }
  if (const std::string mark = text.substr(0, 2); mark == "\xff\xfe" || mark == "\xfe\xff") {
    text = of_utf_16(text);
  }
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
    refuse(file, fmt::format("is no text, byte {} is 0", zero));
  }
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    refuse(file, "is empty");
  }
  const bool marked = text.compare(0, 3, "\xef\xbb\xbf") == 0;
  return {file, marked ? text.substr(3) : std::move(text)};
}

std::vector<Line> lines_of(const scene_file::Source& source) {
  std::string_view text = source.text;
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    // Instruments of old end their lines with CR alone.
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    if (line.find_first_not_of(" \t\v\f") != std::string_view::npos) {
      lines.push_back({line, number});
    }
    if (lines.size() > most_lines) {
      throw SceneError({source.file, number, 1}, "file",
                       fmt::format("has too many lines; allowed: up to {}", most_lines));
    }
    const bool both = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(end + (both ? 2 : 1), text.size()));
  }
  return lines;
}

std::vector<Cell> cells_of(std::string_view line, char separator) {
  const bool by_blanks = separator == ' ';
  const std::string_view skipped = by_blanks ? " \t\r\v\f" : " \v\f";
  const std::string_view ends = by_blanks ? skipped : std::string_view(&separator, 1);
  std::vector<Cell> cells;
  std::size_t at = 0;
  while (cells.size() <= most_cells) {
    const std::size_t first = std::min(line.find_first_not_of(skipped, at), line.size());
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

bool is_comment(std::string_view line) {
  // A tab before it is an empty first cell.
  const std::size_t first = line.find_first_not_of(' ');
  return first != std::string_view::npos &&
         std::string_view("#!%").find(line[first]) != std::string_view::npos;
}

std::string warning_of_cut(const scene_file::Source& source) {
  const std::string_view text = source.text;
  const std::size_t end = text.find_last_of("\r\n");
  const std::string_view last =
      trimmed(end == std::string_view::npos ? text : text.substr(end + 1));
  if (last.empty() || last == "END") {
    return {};
  }
  return fmt::format("The last line, \"{}\", has no line end: if the file was cut, it is wrong.",
                     shortened(last));
}

}  // namespace sonoglide::identify
