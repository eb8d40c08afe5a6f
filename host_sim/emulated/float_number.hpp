/// A number as C++ writes it.
#pragma once

#include <fmt/format.h>

#include <string>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::emulated {

/// The float nearest to a value as a literal, bit for bit.
inline std::string float_number(double value) {
  return fmt::format("{:a}F", static_cast<double>(numeric::from_real<float>(value)));
}

}  // namespace sonoglide::emulated
