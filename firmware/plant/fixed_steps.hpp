/// How a fixed-step method cuts an interval.
#pragma once

#include <cstdint>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// The smallest number of equal steps no longer than longest_step. A number above `limit` is not
/// told exactly: it is given as limit + 1.
///
/// A step that fits a whole number of times to within 1e-5 of it counts as fitting.
template <class Scalar>
std::uint32_t fixed_step_count(Scalar duration, Scalar longest_step, std::uint32_t limit) {
  const Scalar steps = duration / longest_step * numeric::from_real<Scalar>(1.0 - 1e-5);
  if (!(steps <= static_cast<Scalar>(limit))) {
    return limit + 1;
  }
  const auto whole = static_cast<std::uint32_t>(steps);
  return steps > static_cast<Scalar>(whole) ? whole + 1 : whole;
}

}  // namespace sonoglide::plant
