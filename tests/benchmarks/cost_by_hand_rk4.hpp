/// The loop by hand of the classical Runge–Kutta method, fixed step.
#pragma once

#include "cost_by_hand.hpp"
#include "cost_scene.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::cost::by_hand {
/// The plant at one stage of a step; slopes with respect to tau.
struct Stage {
  double drive;
  double displacement;
  double velocity;  ///< and the slope of the displacement
  double friction;
  double velocity_slope;
  double friction_slope;
};

[[gnu::always_inline]] inline Stage stage(const Scene& scene, const Named& named, double drive,
                                          double displacement, double velocity, double friction) {
  Stage k = {drive, displacement, velocity, friction, 0.0, 0.0};
  const double sliding = scene.sliding_velocity + velocity;
  if (named.law == Law::coulomb) {
    k.friction =
        static_cast<double>(static_cast<int>(sliding > 0.0) - static_cast<int>(sliding < 0.0));
  }
  if (named.law == Law::dahl) {
    k.friction_slope = scene.contact_stiffness * (sliding - numeric::abs(sliding) * friction);
  }
  // -0 - x is -x to a compiler, 0 - x is not.
  const double pull = named.driven ? drive : -0.0;
  const double undamped = named.damped ? pull - scene.damping * velocity : pull;
  const double free = undamped - scene.stiffness * displacement;
  k.velocity_slope = named.law == Law::none ? free : free - scene.friction_force * k.friction;
  return k;
}

[[gnu::always_inline]] inline Stage moved(const Scene& scene, const Named& named, double drive,
                                          const Stage& from, const Stage& slope, double time) {
  return stage(scene, named, drive, from.displacement + time * slope.velocity,
               from.velocity + time * slope.velocity_slope,
               from.friction + time * slope.friction_slope);
}

[[gnu::always_inline]] inline double mean(double a, double b, double c, double d) {
  return (1.0 / 6.0) * (a + 2.0 * (b + c) + d);
}

/// Integral over a step of a product that is known at its stages.
[[gnu::always_inline]] inline double simpson(double length, double a, double b, double c,
                                             double d) {
  return length / 6.0 * (a + 2.0 * (b + c) + d);
}
[[gnu::always_inline]] inline double weighted(double sixth, double a, double b, double c,
                                              double d) {
  return ((sixth * a + (sixth + sixth) * b) + (sixth + sixth) * c) + sixth * d;
}

[[gnu::always_inline]] inline void add_energy(Result& sum, const Scene& scene, const Stage& a,
                                              const Stage& b, const Stage& c, const Stage& d,
                                              double length, const Named& named) {
  const double r = scene.sliding_velocity;
  const double sixth = length / 6.0;
  sum.friction_integral += simpson(length, a.friction, b.friction, c.friction, d.friction);
  sum.friction_work += simpson(length, a.friction * (r + a.velocity), b.friction * (r + b.velocity),
                               c.friction * (r + c.velocity), d.friction * (r + d.velocity));
  sum.sliding_work +=
      simpson(length, a.friction * r, b.friction * r, c.friction * r, d.friction * r);
  sum.drive_work += weighted(sixth, a.drive * a.velocity, b.drive * b.velocity,
                             c.drive * c.velocity, d.drive * d.velocity);
  const double velocity_square = weighted(sixth, a.velocity * a.velocity, b.velocity * b.velocity,
                                          c.velocity * c.velocity, d.velocity * d.velocity);
  sum.velocity_square += velocity_square;
  sum.displacement_square +=
      weighted(sixth, a.displacement * a.displacement, b.displacement * b.displacement,
               c.displacement * c.displacement, d.displacement * d.displacement);
  if (named.damped) {
    sum.damping_work += scene.damping * velocity_square;
  }
}

/// The drive at equal steps of phase: one rotation for each.
struct Rotation {
  double in_phase;
  double quadrature;
  double step_cosine;
  double step_sine;
};

inline Rotation rotation_of(const Scene& scene, double spacing) {
  const auto step = numeric::sine_and_cosine(spacing);
  return {scene.drive_amplitude, 0.0, step.cosine, step.sine};
}

[[gnu::always_inline]] inline double next(Rotation& drive) {
  const double in_phase = drive.in_phase * drive.step_cosine - drive.quadrature * drive.step_sine;
  drive.quadrature = drive.quadrature * drive.step_cosine + drive.in_phase * drive.step_sine;
  drive.in_phase = in_phase;
  return in_phase;
}

/// One carrier period; false where it fails.
[[gnu::always_inline]] inline bool advance(Result& state, const Scene& scene, int count,
                                           double length, const Named& named) {
  const double half = length / 2.0;
  Rotation drive = {};
  if (named.driven) {
    drive = rotation_of(scene, half);
  }
  Stage a = stage(scene, named, drive.in_phase, state.displacement, state.velocity, state.friction);
  for (int i = 0; i < count; ++i) {
    const double middle = named.driven ? next(drive) : 0.0;
    const double end = named.driven ? next(drive) : 0.0;
    const Stage b = moved(scene, named, middle, a, a, half);
    const Stage c = moved(scene, named, middle, a, b, half);
    const Stage d = moved(scene, named, end, a, c, length);
    if (named.energy) {
      add_energy(state, scene, a, b, c, d, length, named);
    }
    Stage mid = {};
    mid.velocity = mean(a.velocity, b.velocity, c.velocity, d.velocity);
    mid.velocity_slope =
        mean(a.velocity_slope, b.velocity_slope, c.velocity_slope, d.velocity_slope);
    if (named.law == Law::dahl) {
      mid.friction_slope =
          mean(a.friction_slope, b.friction_slope, c.friction_slope, d.friction_slope);
    }
    a = moved(scene, named, end, a, mid, length);
    ++state.steps;
    if (!numeric::is_finite(a.displacement) || !numeric::is_finite(a.velocity)) {
      return false;
    }
    if (named.law == Law::dahl && !(numeric::abs(a.friction) <= 1.0 + 64.0 * 0x1p-52)) {
      return false;
    }
  }
  state.displacement = a.displacement;
  state.velocity = a.velocity;
  state.friction = a.friction;
  return true;
}

[[gnu::always_inline]] inline Result rk4(const Scene& scene, const Named& named) {
  const double steps = two_pi / fixed_step * (1.0 - 1e-5);
  const int whole = static_cast<int>(steps);
  const int count = steps > whole ? whole + 1 : whole;
  Result state;
  for (int i = 0; i < periods; ++i) {
    if (!advance(state, scene, count, two_pi / count, named)) {
      return {};
    }
  }
  return state;
}

}  // namespace sonoglide::cost::by_hand
