/// What an importer may look for in a shared library.
#pragma once

#include <set>
#include <string>

namespace sonoglide::acceptance {

/// All functions of fmi2Functions.h of FMI 2.0.4 and of fmi3Functions.h of FMI 3.0.1.
std::set<std::string> header_functions();

/// What a tool's listing of a library names: the first group of each line that matches a
/// regular expression.
std::set<std::string> matches_of_lines(const std::string& listing, const std::string& line);

}  // namespace sonoglide::acceptance
