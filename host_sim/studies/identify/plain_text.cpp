#include "host_sim/studies/identify/plain_text.hpp"

#include <algorithm>

namespace sonoglide::identify {
namespace {

struct Spelling {
  std::string_view sign;
  std::string_view ascii;
};

constexpr std::string_view spaces[] = {" ",      "\t",     "\r",     "\v",     "\f",     "\u00a0",
                                       "\u2000", "\u2001", "\u2002", "\u2003", "\u2004", "\u2005",
                                       "\u2006", "\u2007", "\u2008", "\u2009", "\u200a", "\u200b",
                                       "\u202f", "\u205f", "\u3000", "\ufeff"};

constexpr Spelling spellings[] = {{"\u03a9", "Ohm"},
                                  {"\u2126", "Ohm"},
                                  {"\u2127", "Mho"},
                                  {"\u00b5", "u"},
                                  {"\u03bc", "u"},
                                  {"\u00b0", " deg "},
                                  {"\u00ba", " deg "},
                                  {"\u02da", " deg "},
                                  {"\u03b8", " theta "},
                                  {"\u03d1", " theta "},
                                  {"\u0398", " theta "},
                                  {"\u03c6", " phi "},
                                  {"\u03d5", " phi "},
                                  {"\u03a6", " phi "},
                                  {"\u2220", " angle "},
                                  {"\u2221", " angle "},
                                  {"\u2032", "'"},
                                  {"\u2019", "'"},
                                  {"\u2033", "''"},
                                  {"\u201d", "''"},
                                  {"\"", "''"},
                                  {"\u2212", "-"},
                                  {"\u2010", "-"},
                                  {"\u2011", "-"},
                                  {"\u2012", "-"},
                                  {"\u2013", "-"},
                                  {"\u2014", "-"},
                                  {"\u00d7", "*"},
                                  {"\u00b7", "*"},
                                  {"\u22c5", "*"},
                                  {"\u2219", "*"},
                                  {"\u2215", "/"},
                                  {"\u2044", "/"},
                                  {"\u2223", "|"},
                                  {"\\Omega", "Ohm"},
                                  {"\\ohm", "Ohm"},
                                  {"^{\\circ}", " deg "},
                                  {"^\\circ", " deg "},
                                  {"\\mu", "u"},
                                  {"\\theta", " theta "},
                                  {"\\phi", " phi "},
                                  {"\\varphi", " phi "},
                                  {"\\angle", " angle "},
                                  {"\\times", "*"},
                                  {"\\cdot", "*"},
                                  {"\\,", " "},
                                  {"$", ""}};

/// Of bytes that are no UTF-8.
constexpr Spelling latin_1[] = {{"\xb5", "u"}, {"\xb0", " deg "}, {"\xd7", "*"}, {"\xa0", " "}};

constexpr std::string_view superscripts[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3",
                                             "\u2074", "\u2075", "\u2076", "\u2077",
                                             "\u2078", "\u2079", "\u207b", "\u207a"};
constexpr std::string_view lowered = "0123456789-+";

bool begins(std::string_view text, std::size_t at, std::string_view with) {
  return text.compare(at, with.size(), with) == 0;
}

/// Bytes of the character of UTF-8 that begins at a place; 0 where none does.
std::size_t character_at(std::string_view text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t size = first < 0x80U                     ? 1
                           : first >= 0xc2U && first < 0xe0U ? 2
                           : first >= 0xe0U && first < 0xf0U ? 3
                           : first >= 0xf0U && first < 0xf5U ? 4
                                                             : 0;
  for (std::size_t i = 1; i < size; ++i) {
    if (at + i >= text.size() || (static_cast<unsigned char>(text[at + i]) & 0xc0U) != 0x80U) {
      return 0;
    }
  }
  return size;
}

template <std::size_t Count>
const Spelling* spelling_at(std::string_view text, std::size_t at, const Spelling (&among)[Count]) {
  const auto* const found =
      std::find_if(std::begin(among), std::end(among),
                   [&](const Spelling& each) { return begins(text, at, each.sign); });
  return found == std::end(among) ? nullptr : found;
}

/// The character that a superscript raises; 0 where none begins.
char superscript_at(std::string_view text, std::size_t at, std::size_t& size) {
  for (std::size_t i = 0; i < lowered.size(); ++i) {
    if (begins(text, at, superscripts[i])) {
      size = superscripts[i].size();
      return lowered[i];
    }
  }
  return '\0';
}

/// U+FF01 to U+FF5E are ASCII in full width; 0 where none begins.
char full_width_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
  constexpr std::size_t bytes = 3;
  if (at + bytes > text.size() || byte(0) != 0xefU || (byte(1) & 0xfeU) != 0xbcU) {
    return '\0';
  }
  const unsigned code = ((byte(1) & 1U) << 6U) + (byte(2) & 0x3fU) + 0x20U;
  constexpr unsigned first = 0x21;
  constexpr unsigned last = 0x7e;
  return code >= first && code <= last ? static_cast<char>(code) : '\0';
}

}  // namespace

std::size_t blank_at(std::string_view text, std::size_t at) {
  if (text[at] > ' ') {
    return 0;
  }
  for (const std::string_view each : spaces) {
    if (begins(text, at, each)) {
      return each.size();
    }
  }
  return 0;
}

std::string_view trimmed(std::string_view text) {
  std::size_t begin = 0;
  while (begin < text.size() && blank_at(text, begin) > 0) {
    begin += blank_at(text, begin);
  }
  std::size_t end = begin;
  for (std::size_t at = begin; at < text.size();) {
    const std::size_t blank = blank_at(text, at);
    at += std::max<std::size_t>(blank, 1);
    end = blank > 0 ? end : at;
  }
  return text.substr(begin, end - begin);
}

std::string plain_text(std::string_view text) {
  std::string plain;
  bool raised = false;
  bool braced = false;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t size = 0;
    if (const char low = superscript_at(text, at, size)) {
      plain += raised ? "" : "^";
      plain += low;
      raised = true;
      at += size;
      continue;
    }
    raised = false;
    // LaTeX has powers in braces.
    if (begins(text, at, "^{") && !begins(text, at, "^{\\circ}")) {
      plain += '^';
      braced = true;
      at += 2;
      continue;
    }
    if (braced && text[at] == '}') {
      braced = false;
      ++at;
      continue;
    }
    if (const char ascii = full_width_at(text, at)) {
      plain += ascii;
      at += 3;
      continue;
    }
    if (const std::size_t blank = blank_at(text, at)) {
      plain += ' ';
      at += blank;
      continue;
    }
    const std::size_t character = character_at(text, at);
    const Spelling* found =
        character > 0 ? spelling_at(text, at, spellings) : spelling_at(text, at, latin_1);
    const std::string_view sign =
        found != nullptr ? found->sign : text.substr(at, std::max<std::size_t>(character, 1));
    plain += found != nullptr ? found->ascii : sign;
    at += sign.size();
  }
  return plain;
}

}  // namespace sonoglide::identify
