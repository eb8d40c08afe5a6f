/// Friction-ratio map of a LuGre contact.
#pragma once

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::friction {

/// A LuGre contact as its mean friction sees it: friction::LuGre, lengths over the vibration's
/// amplitude. The damping of the bristles has no part: the mean of what it adds is that of a rate.
struct LuGreShape {
  double contact_stiffness;  ///< κ = σ0 X/Fc [-], > 0
  double static_friction;    ///< γ = Fs/Fc [-], ≥ 1
  double stribeck_velocity;  ///< ν = vs/v̂ [-], > 0
  double viscous_friction;   ///< η = σ2 v̂/Fc [-], ≥ 0

  /// g(V), V over v̂.
  double curve(double velocity) const {
    const double part = velocity / stribeck_velocity;
    return 1.0 + (static_friction - 1.0) * numeric::exp(-part * part);
  }
  /// Friction at a steady speed over Fc.
  double undriven(double velocity_ratio) const {
    return curve(velocity_ratio) + viscous_friction * velocity_ratio;
  }
};

namespace lugre_friction_ratio_detail {

constexpr int steps_per_arc = 64;

/// ψ and its integral over the phase, both linear in the ψ that the period begins with.
struct Bristles {
  double part = 1.0;  ///< of that ψ
  double rest = 0.0;
  double integral_part = 0.0;
  double integral_rest = 0.0;

  /// A step in which ψ relaxes to the level by exp(-decay).
  void advance(double level, double decay, double phase) {
    const double left = numeric::exp(-decay);
    const double mean_left = decay > 1e-8 ? -numeric::expm1(-decay) / decay : 1.0;
    integral_part += phase * mean_left * part;
    integral_rest += phase * (level + mean_left * (rest - level));
    part *= left;
    rest = level + left * (rest - level);
  }
};

/// Over the phases from one to another, between which V keeps its sign. Steps are short towards the
/// ends, where V is small and the curve changes.
inline void follow(const LuGreShape& contact, double r, double from, double to,
                   Bristles& bristles) {
  const double direction = r + numeric::cos(numeric::half(from + to)) < 0.0 ? -1.0 : 1.0;
  double phase = from;
  for (int i = 1; i <= steps_per_arc; ++i) {
    const double end =
        from +
        (to - from) * numeric::half(1.0 - numeric::cos(numeric::half_turn * i / steps_per_arc));
    const double length = end - phase;
    const double travel = r * length + numeric::sin(end) - numeric::sin(phase);
    const double curve = contact.curve(r + numeric::cos(numeric::half(phase + end)));
    bristles.advance(direction * curve, contact.contact_stiffness * numeric::abs(travel) / curve,
                     length);
    phase = end;
  }
}

}  // namespace lugre_friction_ratio_detail

/// Mean friction of a LuGre contact under prescribed sinusoidal tangential vibration over Fc,
/// steady state.
///
/// dψ/dθ = κ (V − |V| ψ/g(V)) is linear in ψ, so that one period gives the ψ it returns to:
///   mean(F)/Fc = mean(ψ) + η r.
///
/// @param velocity_ratio  r = Vt / v̂ [-], ≥ 0, v̂ the peak vibration velocity.
/// @param contact         κ, γ, ν and η of the law.
/// @return mean(F)/Fc [-], at least 0
/// Error ≤ 3e-3 for κ in [1e-3, 1e4], γ up to 3 and ν from 0.05 on: 64 steps an arc, in each of
/// which g and the speed are constant (tested against far shorter steps, and against Dahl's map for
/// γ = 1). Smooth in every argument on either side of r = 1.
/// Source: Canudas de Wit 1995 (README.md).
inline double lugre_mean_friction(double velocity_ratio, const LuGreShape& contact) {
  using namespace lugre_friction_ratio_detail;
  const double r = velocity_ratio;
  const double turns_back = r < 1.0 ? numeric::acos(-r) : numeric::half_turn;
  Bristles bristles;
  follow(contact, r, -turns_back, turns_back, bristles);
  if (r < 1.0) {
    follow(contact, r, turns_back, numeric::two_pi - turns_back, bristles);
  }
  const double start = bristles.rest / (1.0 - bristles.part);
  const double mean = (bristles.integral_part * start + bristles.integral_rest) / numeric::two_pi;
  return mean + contact.viscous_friction * r;
}

}  // namespace sonoglide::friction
