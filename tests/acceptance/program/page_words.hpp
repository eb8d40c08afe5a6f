/// What a page of results leaves unexplained.
#pragma once

#include <string>
#include <vector>

namespace sonoglide::acceptance {

/// The symbols in labels of charts and in headings of charts and tables that the page's own table of
/// words and symbols lacks. A symbol is a letter alone, with a prime, or a capital or Greek letter with
/// one letter or digit behind it; units, in brackets or behind a number, are none, nor are short words and the letters of figures, (a).
std::vector<std::string> unexplained_symbols(const std::string& html);

}  // namespace sonoglide::acceptance
