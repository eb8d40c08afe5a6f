/// How the texts for people write a number.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace sonoglide::output {

/// "-" for a figure that is not defined.
inline std::string figure(fmt::format_string<const double&> format, double value) {
  return std::isnan(value) ? "-" : fmt::format(format, value);
}

}  // namespace sonoglide::output
