/// The oscillator under a drive and a friction force that holds: its motion in closed form.
#pragma once

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/ramped_cosine.hpp"
#include "firmware/plant/stiff/free_mode.hpp"

namespace sonoglide::plant {

/// A force: level + slope t + cosine cos t + sine sin t.
template <class Scalar>
struct LinearForce {
  Scalar level = Scalar(0);
  Scalar slope = Scalar(0);
  Scalar cosine = Scalar(0);
  Scalar sine = Scalar(0);
};

template <class Scalar>
LinearForce<Scalar> force_of(const NoDrive::Phasor<Scalar>& /*drive*/) {
  return {};
}
template <class Scalar>
LinearForce<Scalar> force_of(const CosineDrive::Phasor<Scalar>& drive) {
  return {Scalar(0), Scalar(0), drive.in_phase, -drive.quadrature};
}
/// Of an amplitude that holds.
template <class Scalar>
LinearForce<Scalar> force_of(const RampedCosineDrive::Phasor<Scalar>& drive) {
  return {drive.bias, Scalar(0), drive.level.in_phase, -drive.level.quadrature};
}
template <class Scalar>
LinearForce<Scalar> force_of(const StraightDrive::Phasor<Scalar>& drive) {
  return {drive.force, drive.slope, Scalar(0), Scalar(0)};
}

/// Whether force_of() tells all of a drive.
template <class Phasor>
bool is_linear_force(const Phasor& /*drive*/) {
  return true;
}
template <class Scalar>
bool is_linear_force(const RampedCosineDrive::Phasor<Scalar>& drive) {
  return drive.slope.bound() == Scalar(0);
}

/// y'' + d y' + k y = drive - friction from a point on: the forced motion
///   forced.level + forced.slope t + forced.cosine cos t + forced.sine sin t,
/// and the free mode on top of it.
template <class Scalar>
class LinearMotion {
 public:
  LinearMotion(const FreeMode<Scalar>& mode, Scalar stiffness, Scalar damping,
               const LinearForce<Scalar>& drive, Scalar friction, const Point<Scalar>& begin)
      : mode_(mode), stiffness_(stiffness), damping_(damping), drive_(drive) {
    const Scalar beyond = stiffness - Scalar(1);
    const Scalar unit = Scalar(1) / numeric::max(numeric::abs(beyond), damping);
    spring_ = beyond * unit;
    damper_ = damping * unit;
    weight_ = unit / (spring_ * spring_ + damper_ * damper_);
    forced_.slope = drive.slope / stiffness;
    forced_.level = (drive.level - friction - damping * forced_.slope) / stiffness;
    forced_.cosine = weight_ * (spring_ * drive.cosine - damper_ * drive.sine);
    forced_.sine = weight_ * (spring_ * drive.sine + damper_ * drive.cosine);
    free_ = {begin.displacement - forced_.level - forced_.cosine,
             begin.velocity - forced_.slope - forced_.sine};
    creep_ = mode.creep(free_);
  }

  /// At a time since the beginning.
  Point<Scalar> at(Scalar time) const {
    const auto carrier = numeric::sine_and_cosine(time);
    const Point<Scalar> free = mode_.after(free_, time);
    return {free.displacement + (forced_.level + forced_.slope * time +
                                 forced_.cosine * carrier.cosine + forced_.sine * carrier.sine),
            free.velocity +
                (forced_.slope + forced_.sine * carrier.cosine - forced_.cosine * carrier.sine)};
  }

  /// Velocity at a time, without what falls or turns as fast as the mode; bounds of its modulus and
  /// of that of its rate.
  Scalar slow_velocity(Scalar time) const {
    const auto carrier = numeric::sine_and_cosine(time);
    return forced_.slope + forced_.sine * carrier.cosine - forced_.cosine * carrier.sine +
           creep_.after(time);
  }
  Scalar largest_slow_velocity() const {
    return numeric::abs(forced_.slope) + vibration() + numeric::abs(creep_.velocity);
  }
  Scalar largest_slow_acceleration() const {
    return vibration() + numeric::abs(creep_.rate * creep_.velocity);
  }
  /// Bound of the rest.
  Scalar largest_fast_velocity() const { return mode_.largest_speed(free_); }

  /// Of v cos(phase + t) and of v sin(phase + t).
  struct Demodulated {
    Scalar in_phase;
    Scalar quadrature;
  };
  Demodulated demodulated(Scalar time, Scalar phase) const {
    const auto turn = numeric::sine_and_cosine(phase);
    const Demodulated unturned = demodulated(moments(time));
    return {turn.cosine * unturned.in_phase - turn.sine * unturned.quadrature,
            turn.sine * unturned.in_phase + turn.cosine * unturned.quadrature};
  }

  /// Of t v.
  Scalar velocity_moment(Scalar time) const { return velocity_moment(moments(time)); }

  /// From 0 to a time.
  MotionIntegrals<Scalar> integrals(Scalar time) const {
    const Moments m = moments(time);
    const auto& [level, slope, cosine, sine] = forced_;
    const Demodulated velocity = demodulated(m);
    const Scalar travel =
        slope * time + (cosine * (m.cosine - Scalar(1)) + sine * m.sine) + m.free.velocity;
    const Scalar ramped = velocity_moment(m);
    const Squares<Scalar> free = mode_.squares(free_, m.free.end, time);
    MotionIntegrals<Scalar> sum;
    sum.drive_work = drive_.level * travel + drive_.slope * ramped +
                     (drive_.cosine * velocity.in_phase + drive_.sine * velocity.quadrature);
    sum.velocity_square =
        (slope * slope * time + sine * sine * m.cosine_square + cosine * cosine * m.sine_square) +
        numeric::twice(slope * (sine * m.sine + cosine * (m.cosine - Scalar(1))) -
                       sine * cosine * m.product) +
        numeric::twice(slope * m.free.velocity + sine * m.free.velocity_cosine -
                       cosine * m.free.velocity_sine) +
        free.velocity;
    const Scalar third = time * time * time * numeric::from_real<Scalar>(1.0 / 3.0);
    sum.displacement_square =
        (level * level * time + level * slope * time * time + slope * slope * third +
         cosine * cosine * m.cosine_square + sine * sine * m.sine_square) +
        numeric::twice(cosine * sine * m.product +
                       level * (cosine * m.sine + sine * (Scalar(1) - m.cosine)) +
                       slope * (cosine * m.time_cosine + sine * m.time_sine)) +
        numeric::twice(level * m.free.displacement + slope * m.free.time_displacement +
                       cosine * m.free.displacement_cosine + sine * m.free.displacement_sine) +
        free.displacement;
    sum.damping_work = damping_ * sum.velocity_square;
    return sum;
  }

 private:
  Scalar vibration() const { return numeric::abs(forced_.cosine) + numeric::abs(forced_.sine); }

  /// Integrals of the free motion, alone and times t, cos t and sin t. Those of y follow from the
  /// equation of motion, integrated by parts; those of v from them.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): filled at once
  struct FreeMoments {
    Point<Scalar> end;
    Scalar displacement;
    Scalar velocity;
    Scalar time_displacement;
    Scalar time_velocity;
    Scalar displacement_cosine;
    Scalar displacement_sine;
    Scalar velocity_cosine;
    Scalar velocity_sine;
  };
  /// sin and cos of the time, the integrals of their squares, of their product and of t times
  /// either, and that of t.
  struct Moments {
    Scalar cosine;
    Scalar sine;
    Scalar cosine_square;
    Scalar sine_square;
    Scalar product;
    Scalar time_square;
    Scalar time_cosine;
    Scalar time_sine;
    FreeMoments free;
  };

  Moments moments(Scalar time) const {
    const auto [s, c] = numeric::sine_and_cosine(time);
    return {c,
            s,
            numeric::half(time + s * c),
            numeric::half(time - s * c),
            numeric::half(s * s),
            numeric::half(time * time),
            time * s - (Scalar(1) - c),
            s - time * c,
            free_moments(time, c, s)};
  }

  FreeMoments free_moments(Scalar time, Scalar c, Scalar s) const {
    FreeMoments m;
    m.end = mode_.after(free_, time);
    const auto& [y, v] = m.end;
    m.velocity = y - free_.displacement;
    m.displacement = -((v - free_.velocity) + damping_ * m.velocity) / stiffness_;
    m.time_velocity = time * y - m.displacement;
    m.time_displacement = -(time * v - m.velocity + damping_ * m.time_velocity) / stiffness_;
    // [y e^it], and [v e^it] + (d - i) [y e^it] = (1 - k + i d) times the integral of y e^it.
    const Scalar in_phase = y * c - free_.displacement;
    const Scalar quadrature = y * s;
    const Scalar real = (v * c - free_.velocity) + damping_ * in_phase + quadrature;
    const Scalar imaginary = v * s + damping_ * quadrature - in_phase;
    m.displacement_cosine = -weight_ * (spring_ * real - damper_ * imaginary);
    m.displacement_sine = -weight_ * (spring_ * imaginary + damper_ * real);
    m.velocity_cosine = in_phase + m.displacement_sine;
    m.velocity_sine = quadrature - m.displacement_cosine;
    return m;
  }

  /// At phase 0.
  Demodulated demodulated(const Moments& m) const {
    const auto& [level, slope, cosine, sine] = forced_;
    return {slope * m.sine + sine * m.cosine_square - cosine * m.product + m.free.velocity_cosine,
            slope * (Scalar(1) - m.cosine) + sine * m.product - cosine * m.sine_square +
                m.free.velocity_sine};
  }

  Scalar velocity_moment(const Moments& m) const {
    return forced_.slope * m.time_square +
           (forced_.sine * m.time_cosine - forced_.cosine * m.time_sine) + m.free.time_velocity;
  }

  const FreeMode<Scalar>& mode_;
  Scalar stiffness_;
  Scalar damping_;
  LinearForce<Scalar> drive_;
  LinearForce<Scalar> forced_;
  Point<Scalar> free_;
  typename FreeMode<Scalar>::Creep creep_;
  Scalar spring_;  ///< k - 1 and d, over the larger of both
  Scalar damper_;
  Scalar weight_;  ///< 1 / |k - 1 + i d|^2, times that
};

}  // namespace sonoglide::plant
