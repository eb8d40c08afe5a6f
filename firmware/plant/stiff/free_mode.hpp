/// The oscillator that is left to itself: its motion over any time, in closed form.
#pragma once

#include <cstdint>
#include <limits>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::plant {

/// Displacement and velocity.
template <class Scalar>
struct Point {
  Scalar displacement = Scalar(0);
  Scalar velocity = Scalar(0);
};

/// Integrals over a time of v^2 and of y^2.
template <class Scalar>
struct Squares {
  Scalar velocity;
  Scalar displacement;
};

/// h'' + d h' + k h = 0, k > 0, d >= 0. Underdamped or overdamped, nothing is divided by the
/// distance of the two roots, so that a critical damping is no exception.
template <class Scalar>
class FreeMode {
 public:
  FreeMode() = default;
  FreeMode(Scalar stiffness, Scalar damping)
      : stiffness_(stiffness), damping_(damping), decay_(numeric::half(damping)) {
    const Scalar square = decay_ * decay_ - stiffness;
    turns_ = square < Scalar(0);
    root_ = numeric::sqrt(numeric::abs(square));
    fast_ = -(decay_ + root_);
    slow_ = turns_ ? -decay_ : stiffness / fast_;
  }

  /// The motion from a point on, after a time.
  Point<Scalar> after(const Point<Scalar>& from, Scalar time) const {
    const Flow flow = turns_ ? turning(time) : creeping(time);
    return {flow.displacement * from.displacement + flow.kick * from.velocity,
            flow.velocity * from.velocity - stiffness_ * flow.kick * from.displacement};
  }

  /// The part of h' that falls slowly, as velocity exp(rate t). 0 where no part is much slower than
  /// the rest.
  struct Creep {
    Scalar velocity = Scalar(0);
    Scalar rate = Scalar(0);

    Scalar after(Scalar time) const { return velocity * numeric::exp(rate * time); }
  };
  Creep creep(const Point<Scalar>& from) const {
    if (turns_ || root_ < numeric::half(decay_)) {
      return {};
    }
    const Scalar force = slow_ * from.velocity - stiffness_ * from.displacement;
    return {force / numeric::twice(root_), slow_};
  }

  /// Bound of |h'| from a point on, without that part.
  Scalar largest_speed(const Point<Scalar>& from) const {
    const Scalar creeping = creep(from).velocity;
    if (creeping != Scalar(0)) {
      return numeric::abs(from.velocity - creeping);
    }
    const Scalar force = numeric::abs(stiffness_ * from.displacement + decay_ * from.velocity) +
                         (turns_ ? Scalar(0) : decay_ * numeric::abs(from.velocity));
    return numeric::abs(from.velocity) + force / numeric::max(root_, decay_);
  }

  /// Integrals over the motion between two of its points.
  ///
  /// F = v^2 + d y v + k y^2 falls as exp(-d t), and (y v)' = v^2 - k y^2 - d y v.
  Squares<Scalar> squares(const Point<Scalar>& from, const Point<Scalar>& to, Scalar time) const {
    const auto& [y, v] = from;
    const Scalar decayed = damping_ * time;
    const Scalar mean_time = decayed > Scalar(0) ? -numeric::expm1(-decayed) / damping_ : time;
    const Scalar sum = mean_time * (v * v + y * (damping_ * v + stiffness_ * y));
    const Scalar product = to.displacement * to.velocity - y * v;
    const Scalar square = to.displacement * to.displacement - y * y;
    return {numeric::half(sum + product),
            numeric::half(sum - product - damping_ * square) / stiffness_};
  }

  /// Rounding error of the phase, within a time or until the mode has decayed [rad].
  Scalar phase_error(Scalar time) const {
    return turns_ ? std::numeric_limits<Scalar>::epsilon() * root_ *
                        (decay_ * time > Scalar(1) ? Scalar(1) / decay_ : time)
                  : Scalar(0);
  }

 private:
  /// h after a time, of a unit displacement and of a unit velocity; h' of a unit velocity.
  struct Flow {
    Scalar displacement;
    Scalar kick;
    Scalar velocity;
  };

  Flow turning(Scalar time) const {
    constexpr Scalar inverse_pi = numeric::from_real<Scalar>(2.0 / numeric::two_pi);
    // Later the mode has long decayed, or its phase is lost.
    constexpr Scalar most = numeric::power_of_two<Scalar>(60);
    const Scalar half_turns = numeric::min(most, inverse_pi * (root_ * time));
    const auto turns = static_cast<std::int64_t>(numeric::half(half_turns));
    const Scalar rest = half_turns - numeric::twice(static_cast<Scalar>(turns));
    const Scalar left = numeric::exp(-decay_ * time);
    const Scalar cosine = left * numeric::cos_pi(rest);
    const Scalar kick = left * numeric::sin_pi(rest) / root_;
    return {cosine + decay_ * kick, kick, cosine - decay_ * kick};
  }
  Flow creeping(Scalar time) const {
    const Scalar left = numeric::exp(slow_ * time);
    const Scalar apart = numeric::twice(root_);
    const Scalar passed = apart * time;
    const Scalar kick = left * (passed > Scalar(0) ? -numeric::expm1(-passed) / apart : time);
    return {left - slow_ * kick, kick, left * numeric::exp(-passed) + slow_ * kick};
  }

  Scalar stiffness_ = Scalar(1);
  Scalar damping_ = Scalar(0);
  Scalar decay_ = Scalar(0);  ///< d/2
  bool turns_ = true;         ///< underdamped
  Scalar root_ = Scalar(1);   ///< sqrt |d^2/4 - k|
  Scalar fast_ = Scalar(0);   ///< of the two rates where they are real
  Scalar slow_ = Scalar(0);
};

}  // namespace sonoglide::plant
