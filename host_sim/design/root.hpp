/// Where a monotone function passes zero.
#pragma once

#include <boost/math/tools/toms748_solve.hpp>

#include <cstdint>
#include <optional>

namespace sonoglide::design {

/// Root near a guess, by TOMS 748 once it is bracketed.
///
/// @param function  of a positive number; rising or falling throughout
/// @param guess     > 0; better within a tenth
/// @return relative error 1e-11; nothing where no root is bracketed within some orders of magnitude
template <class Function>
std::optional<double> root_near(const Function& function, double guess, bool rising) {
  constexpr double first_factor = 1.1;
  constexpr int bits = 37;
  constexpr std::uintmax_t most_evaluations = 100;
  std::uintmax_t evaluations = most_evaluations;
  try {
    const auto [low, high] = boost::math::tools::bracket_and_solve_root(
        function, guess, first_factor, rising, boost::math::tools::eps_tolerance<double>(bits),
        evaluations);
    return evaluations < most_evaluations ? std::optional(0.5 * low + 0.5 * high) : std::nullopt;
  } catch (const boost::math::evaluation_error&) {
    return std::nullopt;
  }
}

}  // namespace sonoglide::design
