/// Bounds as messages show them.
#pragma once

#include <string>

namespace sonoglide::scene {

/// A least or most value in decimal, with at most so many significant digits, and rounded toward what
/// is allowed: the number that is read back from the text is not beyond the bound.
/// @param digits  1 to 17
std::string at_least(double bound, int digits = 6);
std::string at_most(double bound, int digits = 6);

}  // namespace sonoglide::scene
