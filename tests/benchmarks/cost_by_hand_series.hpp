/// What the hand-written Taylor loops have in common: order 16, double, no composition.
///
/// Arithmetic is in the order that plant::EventTaylor has it, so that results can be compared bit
/// for bit.
#pragma once

#include <array>
#include <limits>

#include "cost_scene.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/quick_root.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::cost {

inline constexpr int order = 16;
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr std::uint32_t step_limit = 1000000;
using Coefficients = std::array<double, order + 1>;
/// Of the velocity, one power above the force.
using Motion = std::array<double, order + 2>;

/// Of the last two terms of a step.
inline constexpr double allowed_term = 4.0 * tolerance;

inline double longest_step() {
  double product = allowed_term;
  for (int n = 2; n <= order + 1; ++n) {
    product *= n;
  }
  return numeric::min(3.0, 0.85 * numeric::quick_root<order + 1>(product));
}

/// p[2] + p[3] x + … + p[17] x^15.
[[gnu::always_inline]] inline double beyond_linear(const Motion& p, double x) {
  const double square = x * x;
  const double fourth = square * square;
  const double a = ((p[14] * fourth + p[10]) * fourth + p[6]) * fourth + p[2];
  const double b = ((p[15] * fourth + p[11]) * fourth + p[7]) * fourth + p[3];
  const double c = ((p[16] * fourth + p[12]) * fourth + p[8]) * fourth + p[4];
  const double d = ((p[17] * fourth + p[13]) * fourth + p[9]) * fourth + p[5];
  return (a + x * b) + square * (c + x * d);
}

/// p[0] + p[1] x + … + p[16] x^16.
[[gnu::always_inline]] inline double whole(const Coefficients& p, double x) {
  const double square = x * x;
  const double fourth = square * square;
  const double a = (((p[16] * fourth + p[12]) * fourth + p[8]) * fourth + p[4]) * fourth + p[0];
  const double b = ((p[13] * fourth + p[9]) * fourth + p[5]) * fourth + p[1];
  const double c = ((p[14] * fourth + p[10]) * fourth + p[6]) * fourth + p[2];
  const double d = ((p[15] * fourth + p[11]) * fourth + p[7]) * fourth + p[3];
  return (a + x * b) + square * (c + x * d);
}

/// Coefficients about one instant in x = (tau - tau0) / unit.
struct Series {
  double unit;
  double rate;
  double displacement;  ///< y at x = 0
  double velocity;      ///< v there
  double vibration;     ///< unit v
  Coefficients drive;
  Motion travel;  ///< of the sliding velocity, times unit; above x^0 that of the vibration
  Motion shift;   ///< of the displacement, x apart
  Coefficients friction;
};

struct Phasor {
  double in_phase;
  double quadrature;
};

inline Phasor drive_at(double amplitude, double phase) {
  const auto angle = numeric::sine_and_cosine(phase);
  return {amplitude * angle.cosine, amplitude * angle.sine};
}

[[gnu::always_inline]] inline void set_drive(Series& s, const Phasor& phasor) {
  const double minus_square = -(s.unit * s.unit);
  s.drive[0] = phasor.in_phase;
  s.drive[1] = -phasor.quadrature * s.unit;
  for (std::size_t n = 2; n <= order; ++n) {
    const double reciprocals = (1.0 / static_cast<double>(n)) * (1.0 / static_cast<double>(n - 1));
    s.drive[n] = s.drive[n - 2] * (minus_square * reciprocals);
  }
}

/// The force on the oscillator beside that of the contact, times unit^2 / (n + 1).
[[gnu::always_inline]] inline double free_term(Series& s, const Scene& scene, std::size_t n,
                                               bool driven, bool damped) {
  const double square = s.unit * s.unit;
  const double motion = n == 0 ? s.vibration : s.travel[n];
  double spring = square * scene.stiffness * s.displacement;
  if (n > 0) {
    s.shift[n - 1] = (1.0 / static_cast<double>(n)) * (n == 1 ? s.vibration : s.travel[n - 1]);
    spring = square * scene.stiffness * s.shift[n - 1];
  }
  const double undamped = driven ? square * s.drive[n] - spring : -spring;
  const double free = damped ? undamped - scene.damping * (s.unit * motion) : undamped;
  return (1.0 / static_cast<double>(n + 1)) * free;
}

[[gnu::always_inline]] inline void close_shift(Series& s) {
  s.shift[order] = (1.0 / (order + 1)) * s.travel[order];
  s.shift[order + 1] = (1.0 / (order + 2)) * s.travel[order + 1];
}

[[gnu::always_inline]] inline double displacement_at(const Series& s, double x) {
  return s.displacement + x * (s.shift[0] + x * (s.shift[1] + x * beyond_linear(s.shift, x)));
}
[[gnu::always_inline]] inline double velocity_at(const Series& s, double x) {
  return s.velocity + s.rate * (x * (s.travel[1] + x * beyond_linear(s.travel, x)));
}

/// The extent at which terms of the two highest orders reach what is allowed.
[[gnu::always_inline]] inline double reach(double last, double last_but_one, double allowed) {
  return numeric::min(numeric::quick_root_of_quotient<order + 1>(allowed, last),
                      numeric::quick_root_of_quotient<order>(allowed, last_but_one));
}

/// What a step of extent x reaches; 1 at most.
[[gnu::always_inline]] inline double speed_within(const Series& s, double x) {
  const double change = x * (numeric::abs(s.travel[1]) + x * numeric::abs(s.travel[2]));
  return numeric::clamp(numeric::abs(s.velocity) + numeric::abs(s.rate) * change, 1e-12, 1.0);
}

[[gnu::always_inline]] inline double step_extent(double last, double last_but_one, double allowed,
                                                 double unit, double longest, double remaining) {
  if ((unit == longest || remaining <= 1.0) && last <= allowed && last_but_one <= allowed) {
    return numeric::min(1.0, remaining);
  }
  return numeric::min(reach(last, last_but_one, allowed), numeric::min(longest / unit, remaining));
}

}  // namespace sonoglide::cost
