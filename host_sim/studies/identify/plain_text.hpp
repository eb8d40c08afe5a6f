/// The signs of instruments and spreadsheets as ASCII.
#pragma once

#include <string>
#include <string_view>

namespace sonoglide::identify {

/// Without the blanks of ASCII around it.
std::string_view trimmed(std::string_view text);

/// The beginning of a text, for a message.
std::string shortened(std::string_view text);

std::string lower_case(std::string_view text);

/// Whether a word is one of a list, each between blanks.
bool is_among(std::string_view word, std::string_view list);

/// The same text with ASCII words for signs: `Ohm` for both omegas, `u` for both micro signs, `deg`,
/// `theta`, `phi`, `angle`, `^-6` for superscripts, `*` for multiplication signs, `-` for Unicode's
/// minus and dashes, a space for its spaces, English for Chinese and Japanese words. The words of
/// LaTeX (`k\Omega`, `^\circ`) and the signs of Latin-1 are understood too. What is left beyond ASCII
/// has no such spelling.
std::string plain_text(std::string_view text);

}  // namespace sonoglide::identify
