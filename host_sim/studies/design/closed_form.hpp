/// Friction ratio under a prescribed sinusoidal vibration: what the controller's feedforward
/// believes.
#pragma once

#include <boost/math/tools/toms748_solve.hpp>

#include <cstdint>
#include <optional>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::design {

/// Of a root: a relative error of 1e-13.
inline constexpr int root_bits = 44;

/// Root near a guess, by TOMS 748 once it is bracketed.
///
/// @param function  of a positive number; rising or falling throughout
/// @param guess     > 0; better within a tenth
/// @return nothing where no root is bracketed within some orders of magnitude
template <class Function>
std::optional<double> root_near(const Function& function, double guess, bool rising) {
  constexpr double first_factor = 1.1;
  constexpr std::uintmax_t most_evaluations = 100;
  std::uintmax_t evaluations = most_evaluations;
  try {
    const auto [low, high] = boost::math::tools::bracket_and_solve_root(
        function, guess, first_factor, rising, boost::math::tools::eps_tolerance<double>(root_bits),
        evaluations);
    return evaluations < most_evaluations ? std::optional(0.5 * low + 0.5 * high) : std::nullopt;
  } catch (const boost::math::evaluation_error&) {
    return std::nullopt;
  }
}

/// Root by TOMS 748 where the function has one sign at `low` and the other at `high`.
template <class Function>
double root_between(const Function& function, double low, double high) {
  std::uintmax_t evaluations = 100;
  const auto [below, above] = boost::math::tools::toms748_solve(
      function, low, high, boost::math::tools::eps_tolerance<double>(root_bits), evaluations);
  return 0.5 * below + 0.5 * above;
}

/// The closed form of the scene's law, Dahl, Coulomb or the averaged Stribeck curve.
///
/// @param sliding_m_per_s    > 0
/// @param vibration_m_per_s  peak velocity v̂, > 0
double closed_form_ratio(const scene::Scene& scene, double sliding_m_per_s,
                         double vibration_m_per_s);

/// A friction ratio and the least vibration that gives it.
struct RequiredVibration {
  double friction_ratio;
  double velocity_m_per_s;  ///< peak
};

/// The vibration that gives a ratio; friction_ratio differs from the one asked for where no
/// vibration up to 10^6 times the sliding gives that: it is the lowest then.
///
/// @param ratio  less than without vibration
RequiredVibration closed_form_vibration(const scene::Scene& scene, double sliding_m_per_s,
                                        double ratio);

/// Drive force that a vibration takes without a contact [N].
double force_N(const scene::Scene& scene, double vibration_m_per_s);

}  // namespace sonoglide::design
