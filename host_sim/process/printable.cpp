#include "host_sim/process/printable.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>

namespace sonoglide::process {
namespace {

/// One character of a text, or a single byte that begins none.
struct Character {
  std::size_t bytes;
  char32_t code;
  bool valid;
};

constexpr Character broken{1, 0, false};

std::uint8_t byte_at(std::string_view text, std::size_t index) {
  return static_cast<std::uint8_t>(text[index]);
}

/// What the first byte says of the number of bytes; 0 for one that begins no character.
std::size_t length_of(std::uint8_t lead) {
  if (lead < 0x80) {
    return 1;
  }
  if (lead >= 0xc2 && lead < 0xe0) {
    return 2;
  }
  if (lead >= 0xe0 && lead < 0xf0) {
    return 3;
  }
  return lead >= 0xf0 && lead < 0xf5 ? 4 : 0;
}

/// Not overlong, no surrogate, not beyond the last code point.
bool is_scalar(char32_t code, std::size_t bytes) {
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  return code >= least[bytes] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
}

/// @param text  not empty
Character first_of(std::string_view text) {
  const std::uint8_t lead = byte_at(text, 0);
  const std::size_t bytes = length_of(lead);
  if (bytes == 0 || bytes > text.size()) {
    return broken;
  }
  constexpr std::uint8_t payload[] = {0, 0x7f, 0x1f, 0x0f, 0x07};
  char32_t code = lead & payload[bytes];
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte_at(text, i) & 0xc0U) != 0x80) {
      return broken;
    }
    code = code << 6U | (byte_at(text, i) & 0x3fU);
  }
  return is_scalar(code, bytes) ? Character{bytes, code, true} : broken;
}

bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x2028 || code == 0x2029;
}

/// The two code points of the first plane that XML has no characters for, not even escaped.
bool is_no_xml(char32_t code) {
  return code == 0xfffe || code == 0xffff;
}

bool turns_direction(char32_t code) {
  return code == 0x061c || code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

std::string with_escapes(std::string_view text, std::string_view kept) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character character = first_of(text);
    const std::string_view bytes = text.substr(0, character.bytes);
    text.remove_prefix(character.bytes);
    const bool plain = character.valid && !is_control(character.code) &&
                       !turns_direction(character.code) && !is_no_xml(character.code);
    if (plain || kept.find(bytes) != std::string_view::npos) {
      result += bytes;
      continue;
    }
    for (const char each : bytes) {
      fmt::format_to(std::back_inserter(result), "\\x{:02x}", static_cast<std::uint8_t>(each));
    }
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) {
  return with_escapes(text, "");
}

std::string printable_lines(std::string_view text) {
  return with_escapes(text, "\n\t");
}

void show_on_stderr(std::string_view text) {
  std::fputs((printable_lines(text) + '\n').c_str(), stderr);
}

}  // namespace sonoglide::process
