/// Closed-form friction-ratio map of an Iwan contact.
#pragma once

#include <cstddef>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::friction {

namespace iwan_friction_ratio_detail {

/// Travel of the contact under a sine, u = r theta + sin theta, in amplitudes.
struct Travel {
  double velocity_ratio;

  double at(double theta) const { return velocity_ratio * theta + numeric::sin(theta); }
  /// Integral of u from one phase to another.
  double integral(double from, double to) const {
    return numeric::half(velocity_ratio * (to - from) * (to + from)) + numeric::cos(from) -
           numeric::cos(to);
  }
  /// Phase in [low, high] at which u passes a value; u is monotone there. Half of the digits are
  /// enough: what is integrated up to there is stationary in it.
  double phase_of(double value, double low, double high) const {
    const bool rises = at(high) > at(low);
    constexpr double accuracy = 1e-9;
    double phase = numeric::half(low + high);
    while (low < phase && phase < high) {
      const double over = at(phase) - value;
      ((over > 0.0) == rises ? high : low) = phase;
      const double newton = phase - over / (velocity_ratio + numeric::cos(phase));
      const bool inside = low < newton && newton < high;
      if (inside && numeric::abs(newton - phase) <= accuracy) {
        return newton;
      }
      phase = inside ? newton : numeric::half(low + high);
    }
    return phase;
  }
};

/// Of one spring that slips at 1.
inline double spring_ratio(double r, double stiffness) {
  const Travel travel{r};
  const double turns_back = numeric::acos(-r);
  const double turns_forward = numeric::two_pi - turns_back;
  const double next = turns_back + numeric::two_pi;
  const double highest = travel.at(turns_back);
  const double lowest = travel.at(turns_forward);
  const double slip_travel = 2.0 / stiffness;
  // Integral over a period of what the friction lacks to 1.
  double lacks = 0.0;
  if (highest - lowest <= slip_travel) {
    const double slips = travel.phase_of(highest, turns_forward, next);
    lacks = stiffness * (highest * (slips - turns_back) - travel.integral(turns_back, slips));
  } else {
    const double slips_back = travel.phase_of(highest - slip_travel, turns_back, turns_forward);
    const double slips = travel.phase_of(lowest + slip_travel, turns_forward, next);
    lacks = stiffness *
                (highest * (slips_back - turns_back) - travel.integral(turns_back, slips_back)) +
            2.0 * (turns_forward - slips_back) +
            (2.0 + stiffness * lowest) * (slips - turns_forward) -
            stiffness * travel.integral(turns_forward, slips);
  }
  return numeric::clamp(1.0 - lacks / numeric::two_pi, 0.0, 1.0);
}

}  // namespace iwan_friction_ratio_detail

/// Friction ratio of an Iwan contact under prescribed sinusoidal tangential vibration, steady
/// state.
///
/// A spring that slips at Fc ends each forward arc slipping. Going back it unloads by Kt times the
/// travel, until it slips backwards, and is loaded again on the next forward arc: ρ is 1 less the
/// mean of what it lacks to Fc, an integral of r θ + sin θ between phases that are roots. Spring i
/// of n, of stiffness Kt/n, slips at q_i Fc, so that ρ = Σ q_i ρ₁(r, κ/(n q_i)).
///
/// @param velocity_ratio  r = Vt / v̂ [-], v̂ the peak vibration velocity; |r| is used.
/// @param stiffness       κ = Kt X / Fc [-], X the vibration amplitude; > 0.
/// @param elements        n, at least 1.
/// @return mean(F)/Fc [-] in [0, 1]; 1 for r ≥ 1.
/// Error ≤ 1e-9 for κ in [1e-4, 1e6] (tested against springs that are followed in short steps).
/// Limits: (1 − κ)₊ as r → 0 with one spring; (2/π) asin r (Coulomb) as κ → ∞.
/// Source: Iwan 1966 (README.md), integrated between the phases at which a spring slips.
inline double iwan_friction_ratio(double velocity_ratio, double stiffness, std::size_t elements) {
  const double r = numeric::abs(velocity_ratio);
  if (!(r < 1.0)) {
    return 1.0;
  }
  const auto n = static_cast<double>(elements);
  double sum = 0.0;
  for (std::size_t i = 0; i < elements; ++i) {
    const double limit = static_cast<double>(2 * i + 1) / (n * n);
    sum += limit * iwan_friction_ratio_detail::spring_ratio(r, stiffness / (n * limit));
  }
  return sum;
}

}  // namespace sonoglide::friction
