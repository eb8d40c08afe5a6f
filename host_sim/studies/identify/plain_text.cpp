#include "host_sim/studies/identify/text_file.hpp"

#include <algorithm>
#include <cctype>

#include "host_sim/process/printable.hpp"

namespace sonoglide::identify {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

struct Spelling {
  std::string_view ascii;  ///< of a superscript it begins with ^
  /// Between blanks; of two that begin alike the longer one is first. Single bytes are of Latin-1.
  std::string_view signs;
};

constexpr Spelling spellings[] = {
    {" ",
     "\u00a0 \u2000 \u2001 \u2002 \u2003 \u2004 \u2005 \u2006 \u2007 \u2008 \u2009 \u200a \u200b "
     "\u202f \u205f \u3000 \ufeff \\, \t \v \f \xa0"},
    {"", "$"},
    {"Ohm", "\u03a9 \u2126 \\Omega \\ohm \u6b27\u59c6 \u6b50\u59c6"},
    {"Mho", "\u2127"},
    {" Hz ", "\u8d6b\u5179"},
    {"u", "\u00b5 \u03bc \\mu \xb5"},
    {" deg ", "\u00b0 \u00ba \u02da ^{\\circ} ^\\circ \u5ea6 \xb0"},
    {" theta ", "\u03b8 \u03d1 \u0398 \\theta"},
    {" phi ", "\u03c6 \u03d5 \u03a6 \\phi \\varphi"},
    {" angle ", "\u2220 \u2221 \\angle"},
    {"'", "\u2032 \u2019"},
    {"''", "\u2033 \u201d \""},
    {"-", "\u2212 \u2010 \u2011 \u2012 \u2013 \u2014"},
    {"*", "\u00d7 \u00b7 \u22c5 \u2219 \\times \\cdot \xd7 \xb7"},
    {"/", "\u2215 \u2044"},
    {"|", "\u2223"},
    {"(", "\uff08"},
    {")", "\uff09"},
    {",", "\uff0c"},
    {":", "\uff1a"},
    {"e", "\u00e9"},
    {"^", "^{"},
    {"^0", "\u2070"},
    {"^1", "\u00b9"},
    {"^2", "\u00b2 \xb2"},
    {"^3", "\u00b3 \xb3"},
    {"^4", "\u2074"},
    {"^5", "\u2075"},
    {"^6", "\u2076"},
    {"^7", "\u2077"},
    {"^8", "\u2078"},
    {"^9", "\u2079"},
    {"^-", "\u207b"},
    {"^+", "\u207a"},
    {" frequency ", "\u9891\u7387 \u983b\u7387 \u5468\u6ce2\u6570"},
    {" impedance ", "\u963b\u6297"},
    {" admittance ", "\u5bfc\u7eb3 \u5c0e\u7d0d"},
    {" phase ", "\u76f8\u4f4d\u89d2 \u76f8\u4f4d \u76f8\u89d2 \u4f4d\u76f8"},
    {" resistance ", "\u7535\u963b \u96fb\u963b"},
    {" reactance ", "\u7535\u6297 \u96fb\u6297"},
    {" conductance ", "\u7535\u5bfc \u96fb\u5c0e"},
    {" susceptance ", "\u7535\u7eb3 \u96fb\u7d0d"},
    {" magnitude ", "\u5e45\u503c \u6a21\u503c \u6a21"}};

/// The sign that begins a text, and what it is in ASCII; no sign where none does.
Spelling first_sign(std::string_view text) {
  for (const Spelling& each : spellings) {
    for (std::string_view left = each.signs; !left.empty();) {
      const std::string_view sign = left.substr(0, left.find(' '));
      if (text.substr(0, sign.size()) == sign) {
        return {each.ascii, sign};
      }
      left.remove_prefix(std::min(sign.size() + 1, left.size()));
    }
  }
  return {};
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::string shortened(std::string_view text) {
  constexpr std::size_t most = 40;
  text = trimmed(text);
  if (text.size() <= most) {
    return process::printable(text);
  }
  const auto continues = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xc0U) == 0x80U;
  };
  constexpr std::size_t longest_character = 4;
  std::size_t cut = 0;
  while (cut < longest_character && continues(most - cut)) {
    ++cut;
  }
  return process::printable(text.substr(0, cut < longest_character ? most - cut : most));
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
  while (!text.empty()) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(text[0])) != 0;  // Most are.
    const Spelling known = is_plain ? Spelling() : first_sign(text);
    const bool is_power = known.ascii.substr(0, 1) == "^";
    std::size_t size = known.signs.size();
    if (size > 0) {
      plain += known.ascii.substr(raised && is_power ? 1 : 0);
      braced = braced || known.signs == "^{";
    } else if (braced && text[0] == '}') {  // LaTeX has powers in braces.
      braced = false;
      size = 1;
    } else {
      const bool is_long = static_cast<unsigned char>(text[0]) >= 0xc0U;
      do {  // A sign of UTF-8 that is not known, whole.
        plain += text[size++];
      } while (is_long && size < text.size() &&
               (static_cast<unsigned char>(text[size]) & 0xc0U) == 0x80U);
    }
    raised = is_power;
    text.remove_prefix(size);
  }
  return plain;
}

}  // namespace sonoglide::identify
