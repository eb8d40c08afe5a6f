/// Words and symbols, told once in host_sim/glossary.md.
#pragma once

#include <string_view>

#include "host_sim/output/page.hpp"

namespace sonoglide::output {

/// The glossary, built into the program (see assets.cmake).
std::string_view glossary_md();

/// Each symbol and each term of the glossary that the page uses, and each symbol in their meanings, in a
/// folded table; symbols first.
///
/// A term may stand in the plural and begin a sentence. Inside a longer term it is not looked for. A
/// letter behind a number, or in square brackets, is a unit and no symbol. The scene and the command
/// that were run are left aside.
Table words_of(const Page& page);

}  // namespace sonoglide::output
