#include "host_sim/studies/identify/plain_text.hpp"

#include <algorithm>
#include <cctype>

namespace sonoglide::identify {
namespace {

constexpr std::string_view spaces =
    "\u00a0 \u2000 \u2001 \u2002 \u2003 \u2004 \u2005 \u2006 \u2007 \u2008 \u2009 \u200a \u200b "
    "\u202f \u205f \u3000 \ufeff";

struct Spelling {
  std::string_view ascii;
  std::string_view signs;  ///< between blanks
};

constexpr Spelling spellings[] = {{"Ohm", "\u03a9 \u2126 \\Omega \\ohm"},
                                  {"Mho", "\u2127"},
                                  {"u", "\u00b5 \u03bc \\mu"},
                                  {" deg ", "\u00b0 \u00ba \u02da ^{\\circ} ^\\circ"},
                                  {" theta ", "\u03b8 \u03d1 \u0398 \\theta"},
                                  {" phi ", "\u03c6 \u03d5 \u03a6 \\phi \\varphi"},
                                  {" angle ", "\u2220 \u2221 \\angle"},
                                  {"'", "\u2032 \u2019"},
                                  {"''", "\u2033 \u201d \""},
                                  {"-", "\u2212 \u2010 \u2011 \u2012 \u2013 \u2014"},
                                  {"*", "\u00d7 \u00b7 \u22c5 \u2219 \\times \\cdot"},
                                  {"/", "\u2215 \u2044"},
                                  {"|", "\u2223"},
                                  {" ", "\\,"},
                                  {"", "$"}};

/// Of bytes that are no UTF-8.
constexpr Spelling latin_1[] = {{"u", "\xb5"}, {" deg ", "\xb0"}, {"*", "\xd7"}, {" ", "\xa0"}};

constexpr Spelling superscripts[] = {{"0", "\u2070"}, {"1", "\u00b9"}, {"2", "\u00b2"},
                                     {"3", "\u00b3"}, {"4", "\u2074"}, {"5", "\u2075"},
                                     {"6", "\u2076"}, {"7", "\u2077"}, {"8", "\u2078"},
                                     {"9", "\u2079"}, {"-", "\u207b"}, {"+", "\u207a"}};

bool begins(std::string_view text, std::size_t at, std::string_view with) {
  return text.compare(at, with.size(), with) == 0;
}

/// The sign of a list that begins at a place; empty where none does.
std::string_view sign_at(std::string_view text, std::size_t at, std::string_view signs) {
  while (!signs.empty()) {
    const std::size_t size = std::min(signs.find(' '), signs.size());
    if (begins(text, at, signs.substr(0, size))) {
      return signs.substr(0, size);
    }
    signs.remove_prefix(std::min(size + 1, signs.size()));
  }
  return {};
}

/// The sign that begins at a place, and what it is in ASCII; no sign where none does.
template <std::size_t Count>
Spelling spelling_at(std::string_view text, std::size_t at, const Spelling (&among)[Count]) {
  for (const Spelling& each : among) {
    if (const std::string_view sign = sign_at(text, at, each.signs); !sign.empty()) {
      return {each.ascii, sign};
    }
  }
  return {};
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
  const char first = text[at];
  if (first > ' ') {
    return 0;
  }
  return std::string_view(" \t\r\v\f").find(first) != std::string_view::npos
             ? 1
             : sign_at(text, at, spaces).size();
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

std::string lower_case(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char each) { return static_cast<char>(std::tolower(each)); });
  return small;
}

bool is_among(std::string_view word, std::string_view list) {
  return list.find(' ' + std::string(word) + ' ') != std::string_view::npos;
}

std::string plain_text(std::string_view text) {
  std::string plain;
  bool raised = false;
  bool braced = false;
  for (std::size_t at = 0; at < text.size();) {
    if (std::isalnum(static_cast<unsigned char>(text[at])) != 0) {  // Most are.
      plain += text[at++];
      raised = false;
      continue;
    }
    const std::size_t character = character_at(text, at);
    const Spelling high = spelling_at(text, at, superscripts);
    const bool opens = begins(text, at, "^{") && !begins(text, at, "^{\\circ}");
    const Spelling known = character > 0 ? spelling_at(text, at, spellings)  //
                                         : spelling_at(text, at, latin_1);
    if (!high.signs.empty()) {
      plain += raised ? "" : "^";
      plain += high.ascii;
      at += high.signs.size();
    } else if (opens || (braced && text[at] == '}')) {  // LaTeX has powers in braces.
      plain += opens ? "^" : "";
      at += opens ? 2 : 1;
      braced = opens;
    } else if (const char ascii = full_width_at(text, at)) {
      plain += ascii;
      at += 3;
    } else if (const std::size_t blank = blank_at(text, at)) {
      plain += ' ';
      at += blank;
    } else if (!known.signs.empty()) {
      plain += known.ascii;
      at += known.signs.size();
    } else {
      const std::size_t size = std::max<std::size_t>(character, 1);
      plain += text.substr(at, size);
      at += size;
    }
    raised = !high.signs.empty();
  }
  return plain;
}

}  // namespace sonoglide::identify
