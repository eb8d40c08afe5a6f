/// What a Dahl contact adds to a hand-written Taylor loop, and the accounts of a run over it.
#pragma once

#include "cost_by_hand.hpp"
#include "cost_by_hand_reversals.hpp"
#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/lane_group.hpp"
#include "firmware/numeric/power_series.hpp"

namespace sonoglide::cost::by_hand {

/// An arc between two reversals: phi moves away from where it is by gap (exp(-kappa |u|) - 1).
struct Arc {
  double direction;
  double friction;
  double decay;
  double gap;
};

inline Arc arc_of(const Scene& scene, double direction, double friction) {
  return {direction, friction, -scene.contact_stiffness * direction, friction - direction};
}

/// (exp(-z) - 1 + z) / z^2, z <= 1.
[[gnu::always_inline]] inline double decay_remainder_series(double z) {
  constexpr std::array<double, 16> c = [] {
    std::array<double, 16> terms{};
    double term = 0.5;
    for (std::size_t n = 0; n < terms.size(); ++n) {
      terms[n] = term;
      term /= -static_cast<double>(n + 3);
    }
    return terms;
  }();
  const double second = z * z;
  const double fourth = second * second;
  const double a = (c[0] + c[1] * z) + (c[2] + c[3] * z) * second;
  const double b = (c[4] + c[5] * z) + (c[6] + c[7] * z) * second;
  const double d = (c[8] + c[9] * z) + (c[10] + c[11] * z) * second;
  const double e = (c[12] + c[13] * z) + (c[14] + c[15] * z) * second;
  return (a + b * fourth) + (d + e * fourth) * (fourth * fourth);
}
inline double decay_remainder(double z) {
  return z < 1.0 ? decay_remainder_series(z) : (numeric::expm1(-z) + z) / (z * z);
}
inline double minus_decayed(double z) {
  return z < 1.0 ? z * (z * decay_remainder_series(z) - 1.0) : numeric::expm1(-z);
}

/// Friction at its limit but for a negligible rest.
[[gnu::always_inline]] inline void settle(Result& state, double velocity) {
  const double limit = velocity > 0.0 ? 1.0 : -1.0;
  if (velocity != 0.0 && 1.0 - limit * state.friction <= numeric::min(0.125 * allowed_term, 1e-6)) {
    state.friction = limit;
  }
}

/// A unit in which the coefficients stay moderate.
inline double series_unit(const Scene& scene, double velocity, double friction, double longest) {
  const double rate = scene.contact_stiffness * numeric::abs(velocity);
  const bool slips = numeric::abs(friction) == 1.0 && velocity * friction > 0.0;
  if (longest * (rate + scene.contact_stiffness * longest) <= 16.0 || slips) {
    return longest;
  }
  return numeric::min(longest, 16.0 / (1.0 + rate));
}

/// s.friction[n] from the terms of travel and phi below n.
[[gnu::always_inline]] inline void add_friction(Series& s, const Arc& arc, std::size_t n) {
  const double factor = arc.decay * (1.0 / static_cast<double>(n));
  if (n == 1) {
    s.friction[1] = factor * arc.gap * s.travel[0];
    return;
  }
  const std::size_t middle = n / 2;
  double sum = n % 2 == 0 ? 0.0 : s.travel[middle] * s.friction[middle];
  for (std::size_t j = middle; j-- > 1;) {
    sum += s.travel[j] * s.friction[n - 1 - j] + s.travel[n - 1 - j] * s.friction[j];
  }
  s.friction[n] = (factor * sum + (factor * arc.gap) * s.travel[n - 1]) +
                  (factor * s.travel[0]) * s.friction[n - 1];
}

[[gnu::always_inline]] inline double travelled(const Series& s, const Arc& arc, double x) {
  const double travel =
      x * ((s.travel[0] + x * (0.5 * s.travel[1])) + (x * x) * beyond_linear(s.shift, x));
  return numeric::max(0.0, arc.direction * travel);
}

/// At the end of a stretch that the contact has travelled.
inline double friction_after(const Scene& scene, const Arc& arc, double travel) {
  return numeric::clamp(arc.friction + arc.gap * minus_decayed(scene.contact_stiffness * travel),
                        -1.0, 1.0);
}

/// Integral of phi over x, by eight nodes on the way that the contact slides.
[[gnu::noinline, gnu::pure]] inline double friction_by_nodes(const Series& s, const Scene& scene,
                                                             const Arc& arc, double extent) {
  constexpr auto& rule = numeric::gauss_rule<double, 8>;
  const auto& p = s.shift;
  const auto x = extent * numeric::load_group<4>(rule.node.data());
  const auto square = x * x;
  auto even = square * p[16] + p[14];
  auto odd = square * p[17] + p[15];
  for (std::size_t n = 12; n > 0; n -= 2) {
    even = even * square + p[n];
    odd = odd * square + p[n + 1];
  }
  even = even * square + s.travel[0];
  odd = odd * square + 0.5 * s.travel[1];
  const auto travel = x * (even + x * odd);
  const auto z = numeric::at_most(64.0, scene.contact_stiffness * (arc.direction * travel));
  const auto friction = arc.direction + arc.gap * numeric::moderate_decay<double>(z);
  return extent * numeric::sum_of_lanes(numeric::load_group<4>(rule.weight.data()) * friction);
}

/// The same by its series, where that has converged.
[[gnu::always_inline]] inline double friction_integral(const Series& s, const Scene& scene,
                                                       const Arc& arc, double extent) {
  const double last =
      numeric::max(extent * numeric::abs(s.friction[order]), numeric::abs(s.friction[order - 1]));
  const double length = numeric::max(1.0, s.unit * extent);
  if (length * numeric::power<order - 1>(extent) * last > 64.0 * allowed_term) {
    return friction_by_nodes(s, scene, arc, extent);
  }
  Coefficients mean;
  for (std::size_t n = 0; n <= order; ++n) {
    mean[n] = s.friction[n] * (1.0 / static_cast<double>(n + 1));
  }
  return whole(mean, extent) * extent;
}

[[gnu::always_inline]] inline void add_motion(Result& state, const Series& s, const Scene& scene,
                                              double extent, const Named& named) {
  static constexpr auto rule = numeric::gauss_legendre<order / 2>();
  double drive_work = 0.0;
  double velocity_square = 0.0;
  double displacement_square = 0.0;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    const double x = extent * rule.node[i];
    const double weight = s.unit * extent * rule.weight[i];
    const double velocity = velocity_at(s, x);
    const double displacement = displacement_at(s, x);
    if (named.driven) {
      drive_work += weight * (whole(s.drive, x) * velocity);
    }
    velocity_square += weight * (velocity * velocity);
    displacement_square += weight * (displacement * displacement);
  }
  state.drive_work += drive_work;
  state.velocity_square += velocity_square;
  state.displacement_square += displacement_square;
  if (named.damped) {
    state.damping_work += scene.damping * velocity_square;
  }
}

[[gnu::always_inline]] inline void add_energy(Result& state, const Series& s, const Scene& scene,
                                              const Arc& arc, double extent, double travel,
                                              const Named& named) {
  const double integral = friction_integral(s, scene, arc, extent);
  const double z = scene.contact_stiffness * travel;
  state.friction_integral += s.unit * integral;
  state.friction_work +=
      arc.direction * (travel * (arc.friction - arc.gap * (z * decay_remainder(z))));
  state.sliding_work += s.unit * (scene.sliding_velocity * integral);
  add_motion(state, s, scene, extent, named);
}

}  // namespace sonoglide::cost::by_hand
