/// Closed-form friction-ratio map of a Dahl contact.
#pragma once

#include <cstddef>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::friction {

namespace dahl_friction_ratio_detail {

/// Exponent beyond which the decay is neglected: the rest adds less than 1e-13 to the ratio. 24
/// nodes resolve the decay up to there.
constexpr double negligible_exponent = 28.0;
constexpr int node_count = 24;
inline constexpr numeric::GaussLegendreRule<node_count> rule =
    numeric::gauss_legendre<node_count>();

/// One arc of V/v̂ = r + cos θ between two reversals, seen from the reversal where it begins:
/// travel(x) = ± (x cos θ* + 2 sin(x/2) cos(x/2 ∓ θ*)), x the phase since then.
struct Arc {
  double turning_phase;  ///< θ* = arccos(−r)
  double cosine;         ///< cos θ* = −r
  double length;         ///< phase from reversal to reversal
  bool forward;

  double travel(double x) const {
    const double half = 0.5 * x;
    const double swing = 2.0 * numeric::sin(half);
    return forward ? swing * numeric::cos(half - turning_phase) - x * cosine
                   : x * cosine - swing * numeric::cos(half + turning_phase);
  }
};

/// Phase beyond which exp(−a·travel) is negligible; the length of the arc if there is none.
inline double effective_length(const Arc& arc, double dahl_number) {
  if (dahl_number * arc.travel(arc.length) <= negligible_exponent) {
    return arc.length;
  }
  double low = 0.0;
  double high = arc.length;
  while (high - low > 1e-3 * high) {
    const double middle = 0.5 * (low + high);
    (dahl_number * arc.travel(middle) < negligible_exponent ? low : high) = middle;
  }
  return high;
}

/// J = ∫ exp(−a·travel) dθ over the arc.
inline double relaxation_integral(const Arc& arc, double dahl_number) {
  const double length = effective_length(arc, dahl_number);
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(node_count); ++i) {
    sum += rule.weight[i] * numeric::exp(-dahl_number * arc.travel(length * rule.node[i]));
  }
  return length * sum;
}

}  // namespace dahl_friction_ratio_detail

/// Friction ratio of a Dahl contact under prescribed sinusoidal tangential vibration, steady state.
///
/// Between two reversals of V the deviation 1 − sF/Fc (s the direction) decays as
/// exp(−Kt·travel/Fc); matching the two arcs of a period gives
///   ρ = [4θ* − 2π − P·Jf + Q·Jb]/(2π),  θ* = arccos(−r),
/// P and Q the deviations just after the reversals, J the integral of the decay over each arc.
///
/// @param velocity_ratio  r = Vt / v̂ [-], v̂ the peak vibration velocity; |r| is used.
/// @param dahl_number     a = Kt·X / Fc [-], X the vibration amplitude; > 0.
/// @return mean(F)/Fc [-] in [0, 1]; 1 for r ≥ 1.
/// Error ≤ 1e-12 for dahl_number in [1e-4, 1e7] (Gauss–Legendre, 24 nodes an arc; tested against
/// quadrature in binary128).
/// Limits: → (2/π) asin r (Coulomb) as a → ∞; → πr / (2(√(1−r²) + r asin r)) as a → 0.
/// Source: Dahl 1968 (README.md), integrated in displacement between velocity reversals.
inline double dahl_friction_ratio(double velocity_ratio, double dahl_number) {
  using namespace dahl_friction_ratio_detail;
  const double r = numeric::abs(velocity_ratio);
  if (!(r < 1.0)) {
    return 1.0;
  }
  const double turning = numeric::acos(-r);
  const Arc forward{turning, -r, 2.0 * turning, true};
  const Arc backward{turning, -r, 2.0 * (numeric::half_turn - turning), false};
  const double ef = -dahl_number * forward.travel(forward.length);
  const double eb = -dahl_number * backward.travel(backward.length);
  const double scale = 2.0 / numeric::expm1(ef + eb);
  const double p = scale * numeric::expm1(eb);
  const double q = scale * numeric::expm1(ef);
  const double sum = 4.0 * turning - numeric::two_pi -
                     p * relaxation_integral(forward, dahl_number) +
                     q * relaxation_integral(backward, dahl_number);
  return numeric::clamp(sum / numeric::two_pi, 0.0, 1.0);
}

}  // namespace sonoglide::friction
