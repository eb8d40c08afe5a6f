#include "host_sim/studies/work_precision/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/studies/work_precision/gragg_bulirsch_stoer.hpp"

namespace sonoglide::work_precision {
namespace {

using Real = long double;

constexpr Real two_pi = 6.283185307179586476925286766559005768L;
constexpr Real longest_step = 0.25L;
constexpr Real shortest_step = 1e-15L;

constexpr ReferenceSetting reference_setting{8, 1e-15L};
constexpr ReferenceSetting check_setting{7, 1e-14L};

static_assert(std::numeric_limits<Real>::digits >= 64, "these tolerances need extended precision");

/// y, y', distance slid since the last reversal, integral of phi since the last restart.
using State = Vector<4>;

/// The numbers of a problem, in the precision of the reference.
struct Numbers {
  Real stiffness;
  Real damping;
  Real friction_force;
  Real contact_stiffness;
  Real vibration_sign;
  Real drive_amplitude;
  Real sliding_velocity;

  explicit Numbers(const peers::Problem& problem)
      : stiffness(static_cast<Real>(problem.stiffness)),
        damping(static_cast<Real>(problem.damping)),
        friction_force(static_cast<Real>(problem.friction_force)),
        contact_stiffness(static_cast<Real>(problem.contact_stiffness)),
        vibration_sign(static_cast<Real>(problem.vibration_sign)),
        drive_amplitude(static_cast<Real>(problem.drive_amplitude)),
        sliding_velocity(static_cast<Real>(problem.sliding_velocity)) {}
};

State initial_state(const peers::Problem& problem) {
  return {static_cast<Real>(problem.displacement), static_cast<Real>(problem.velocity), 0.0L, 0.0L};
}

/// The motion while V keeps its sign.
struct Arc {
  Numbers problem;
  Real direction;  ///< s = sgn V
  Real deficit;    ///< e0 = 1 - s phi where the arc begins

  Real speed(const State& x) const {
    return direction * (problem.sliding_velocity + problem.vibration_sign * x[1]);
  }
  Real remaining_deficit(const State& x) const {
    return deficit * std::exp(-problem.contact_stiffness * x[2]);
  }
  Real friction(const State& x) const { return direction * (1.0L - remaining_deficit(x)); }
  Real acceleration(Real tau, const State& x) const {
    return problem.drive_amplitude * std::cos(tau) - problem.damping * x[1] -
           problem.stiffness * x[0] - problem.friction_force * friction(x);
  }
  /// Slope of the speed.
  Real speeding_up(Real tau, const State& x) const {
    return direction * problem.vibration_sign * acceleration(tau, x);
  }
  State operator()(Real tau, const State& x) const {
    return {x[1], acceleration(tau, x), speed(x), friction(x)};
  }
};

class Motion {
 public:
  Motion(const peers::Problem& problem, const ReferenceSetting& setting)
      : setting_(setting),
        state_(initial_state(problem)),
        arc_{Numbers(problem), initial_direction(problem), 0.0L} {
    arc_.deficit = 1.0L - arc_.direction * static_cast<Real>(problem.friction);
    at_rest_ = arc_.speed(state_) == 0.0L;
  }

  /// One carrier period; returns its integral of phi.
  Real period() {
    state_[3] = 0.0L;
    Real tau = 0.0L;
    while (tau < two_pi) {
      tau = step(tau);
    }
    return state_[3];
  }

  Reference end(Real integral, int periods) const {
    return {integral / (two_pi * periods), state_[0], state_[1], arc_.friction(state_)};
  }

 private:
  static Real initial_direction(const peers::Problem& problem) {
    const Arc forward{Numbers(problem), 1.0L, 1.0L - static_cast<Real>(problem.friction)};
    const State x = initial_state(problem);
    const Real speed = forward.speed(x);
    const Real decisive = speed != 0.0L ? speed : forward.speeding_up(0.0L, x);
    return decisive < 0.0L ? -1.0L : 1.0L;
  }

  Extrapolated<4> attempt(Real tau, Real length) const {
    return gragg_bulirsch_stoer(arc_, tau, state_, length, setting_.columns);
  }

  /// Takes one step of a length that it finds; returns where that ends.
  Real step(Real tau) {
    const Real rest = two_pi - tau;
    Real length = std::min(std::min(next_length_, longest_step), rest);
    for (;;) {
      if (length < shortest_step && length < rest) {
        throw loop::ComputationError("reference: the steps shrink to nothing");
      }
      const Extrapolated<4> tried = attempt(tau, length);
      next_length_ = adapted(length, tried.error);
      if (tried.error > setting_.tolerance) {
        length = next_length_;
        continue;
      }
      const bool reversed = arc_.speed(tried.value) <= 0.0L;
      if ((reversed && at_rest_) || dips(tau, length, tried.value)) {
        length *= 0.5L;
        continue;
      }
      if (reversed) {
        return turn(tau, length);
      }
      state_ = tried.value;
      at_rest_ = false;
      return length == rest ? two_pi : tau + length;
    }
  }

  /// The length at which the error would reach a quarter of the tolerance.
  Real adapted(Real length, Real error) const {
    const Real exponent = 1.0L / (2.0L * setting_.columns - 1.0L);
    const Real factor = std::pow(
        0.25L * setting_.tolerance / std::max(error, 1e-6L * setting_.tolerance), exponent);
    return length * std::clamp(factor, 0.2L, 2.0L);
  }

  /// Whether the speed, as a cubic, reaches zero between two ends at which it is positive.
  bool dips(Real tau, Real length, const State& after) const {
    constexpr int parts = 16;
    const Real from = arc_.speed(state_);
    const Real to = arc_.speed(after);
    if (to <= 0.0L) {
      return false;
    }
    const Real bend_from = length * arc_.speeding_up(tau, state_) - (to - from);
    const Real bend_to = length * arc_.speeding_up(tau + length, after) - (to - from);
    for (int i = 1; i < parts; ++i) {
      const Real z = static_cast<Real>(i) / parts;
      const Real bend = (1.0L - z) * bend_from - z * bend_to;
      if (from + z * (to - from) + z * (1.0L - z) * bend <= 0.0L) {
        return true;
      }
    }
    return false;
  }

  /// Steps to the reversal that lies inside the next `length`; returns where that is.
  Real turn(Real tau, Real length) {
    Real low = 0.0L;
    Real high = length;
    Real guess = length;
    State after = state_;
    // Newton's method, kept inside the bracket by bisection.
    for (int i = 0; i < 60; ++i) {
      after = attempt(tau, guess).value;
      const Real speed = arc_.speed(after);
      (speed > 0.0L ? low : high) = guess;
      const Real newton = guess - speed / arc_.speeding_up(tau + guess, after);
      const Real next = newton > low && newton < high ? newton : 0.5L * (low + high);
      const bool found = std::abs(newton - guess) <= 4.0L * std::numeric_limits<Real>::epsilon();
      if (found || next == guess) {
        break;
      }
      guess = next;
    }
    state_ = after;
    reverse();
    return tau + guess;
  }

  void reverse() {
    const Real friction = arc_.friction(state_);
    state_[1] = -arc_.problem.vibration_sign * arc_.problem.sliding_velocity;
    state_[2] = 0.0L;
    arc_.direction = -arc_.direction;
    arc_.deficit = 1.0L - arc_.direction * friction;
    at_rest_ = true;
  }

  ReferenceSetting setting_;
  State state_;
  Arc arc_;
  bool at_rest_ = false;  ///< V = 0 exactly: a reversal has just been left
  Real next_length_ = 1e-3L;
};

}  // namespace

Reference compute_reference(const peers::Problem& problem, const ReferenceSetting& setting) {
  Motion motion(problem, setting);
  Real integral = 0.0L;
  for (int i = 0; i < problem.periods; ++i) {
    integral += motion.period();
  }
  return motion.end(integral, problem.periods);
}

CheckedReference checked_reference(const peers::Problem& problem) {
  const Reference fine = compute_reference(problem, reference_setting);
  const Reference check = compute_reference(problem, check_setting);
  const Real difference = std::abs(fine.friction_ratio - check.friction_ratio);
  return {fine, difference};
}

}  // namespace sonoglide::work_precision
