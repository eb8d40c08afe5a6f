/// One step of the splitting method: the motion inside it, and its integrals.
#pragma once

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/friction_arcs.hpp"
#include "firmware/plant/oscillator_flow.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/velocity_path.hpp"

namespace sonoglide::plant {

/// The oscillator at one end of its linear flow.
template <class Scalar>
struct FlowEnd {
  State<Scalar> state;  ///< velocity between the kicks; friction before, or after, the step
  DriveForce<Scalar> drive;
  Scalar acceleration;  ///< without friction
};

/// What holds of a step between its two kicks of friction.
template <class Model>
class StrangStep {
 public:
  using Scalar = typename Model::Scalar;
  using Law = typename Model::FrictionLaw;
  using End = FlowEnd<Scalar>;

  StrangStep(const Model& model, const Interval<Scalar>& interval, const End& from, const End& to,
             const VelocityPath<Scalar>& velocity, const FrictionArcs<Law>& friction, Scalar begin,
             Scalar length)
      : model_(model),
        interval_(interval),
        from_(from),
        to_(to),
        velocity_(velocity),
        friction_(friction),
        begin_(begin),
        length_(length) {}

  Scalar begin() const { return begin_; }
  Scalar length() const { return length_; }

  /// The two kicks spread evenly over the step, so that the ends are those of the step.
  State<Scalar> at(Scalar offset) const {
    const Scalar x = offset / length_;
    const Scalar rest = Scalar(1) - x;
    const Scalar half_step = numeric::half(length_);
    const Scalar from_force = model_.contact_force(from_.state.friction);
    const Scalar to_force = model_.contact_force(to_.state.friction);
    const Scalar mean_force = numeric::half(from_force + to_force);
    return {from_.state.displacement + velocity_.displacement(x) +
                half_step * length_ * mean_force * x * rest,
            velocity_.velocity(x) + half_step * (from_force * rest - to_force * x),
            friction_.friction(x)};
  }

  Scalar friction_integral() const { return friction_.integral(Scalar(1), Scalar(0)); }
  Scalar friction_work() const { return friction_.work(); }
  Scalar sliding_work() const {
    return friction_.integral(interval_.sliding_velocity + interval_.sliding_acceleration * begin_,
                              interval_.sliding_acceleration);
  }
  MotionIntegrals<Scalar> motion_integrals() const {
    const Scalar velocity_squares = integral(velocity_square(from_), velocity_square(to_));
    return {integral(drive_power(from_), drive_power(to_)), velocity_squares,
            integral(displacement_square(from_), displacement_square(to_)),
            model_.damping_force(velocity_squares)};
  }

 private:
  /// A function of time and its first two derivatives.
  struct Germ {
    Scalar value;
    Scalar slope;
    Scalar bend;
  };

  /// d acceleration / d tau of the flow.
  Scalar jerk(const End& end) const {
    return model_.acceleration(end.drive.slope, {end.state.velocity, end.acceleration, Scalar(0)});
  }
  Germ drive_power(const End& end) const {
    const Scalar velocity = end.state.velocity;
    const auto [drive, slope] = end.drive;
    return {drive * velocity, drive * end.acceleration + slope * velocity,
            drive * (jerk(end) - velocity) + numeric::twice(slope * end.acceleration)};
  }
  Germ velocity_square(const End& end) const {
    const Scalar velocity = end.state.velocity;
    return {velocity * velocity, numeric::twice(velocity * end.acceleration),
            numeric::twice(end.acceleration * end.acceleration + velocity * jerk(end))};
  }
  Germ displacement_square(const End& end) const {
    const auto& [displacement, velocity, friction] = end.state;
    return {displacement * displacement, numeric::twice(displacement * velocity),
            numeric::twice(velocity * velocity + displacement * end.acceleration)};
  }

  /// Of the quintic with these values and derivatives at the ends.
  Scalar integral(const Germ& from, const Germ& to) const {
    constexpr Scalar fifth = numeric::from_real<Scalar>(1.0 / 5.0);
    constexpr Scalar twelfth = numeric::from_real<Scalar>(1.0 / 12.0);
    const Scalar bends = length_ * twelfth * (from.bend + to.bend);
    const Scalar slopes = length_ * fifth * ((from.slope - to.slope) + bends);
    return numeric::half(length_) * ((from.value + to.value) + slopes);
  }

  const Model& model_;
  const Interval<Scalar>& interval_;
  const End& from_;
  const End& to_;
  const VelocityPath<Scalar>& velocity_;
  const FrictionArcs<Law>& friction_;
  Scalar begin_;
  Scalar length_;
};

}  // namespace sonoglide::plant
