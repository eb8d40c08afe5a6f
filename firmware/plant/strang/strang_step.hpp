/// One step of the splitting method: the motion inside it, and its integrals.
#pragma once

#include <cstddef>
#include <utility>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/strang/friction_arcs.hpp"
#include "firmware/plant/strang/oscillator_flow.hpp"
#include "firmware/plant/velocity_path.hpp"

namespace sonoglide::plant {

/// The oscillator at one end of its linear flow.
template <class Scalar, class Force>
struct FlowEnd {
  State<Scalar> state;  ///< velocity between the kicks; friction before, or after, the step
  Force drive;
  Scalar acceleration;  ///< without friction
};

/// Half a kick of friction; the oscillator's own flow, along which the contact follows its law in
/// displacement; half a kick (Strang 1968, ../README.md).
template <class Model>
class StrangStep {
 public:
  using Scalar = typename Model::Scalar;
  using Law = typename Model::FrictionLaw;
  using Flow = OscillatorFlow<Model>;

  /// begin: time since the interval began. drive: at `begin`; advanced to the end of the step.
  StrangStep(const Model& model, const Flow& flow, const IntervalOf<Model>& interval,
             typename Flow::Follower& drive, Scalar begin, const State<Scalar>& start)
      : model_(model),
        interval_(interval),
        begin_(begin),
        length_(flow.length()),
        start_velocity_(start.velocity),
        from_(flow_end(kicked(start), drive)),
        change_(flow.advance(from_.state, drive)),
        to_(flow_end({from_.state.displacement + change_.displacement,
                      from_.state.velocity + change_.velocity, start.friction},
                     drive)),
        velocity_({from_.state.velocity, from_.acceleration},
                  {to_.state.velocity, to_.acceleration}, change_.displacement * flow.rate(),
                  length_),
        sliding_(velocity_.sliding(model,
                                   interval.sliding_velocity +
                                       Model::Sliding::change(interval.sliding_acceleration, begin),
                                   interval.sliding_acceleration)),
        friction_(model.law, sliding_, length_, start.friction) {
    to_.state.friction = friction_.end_friction();
  }
  StrangStep(const StrangStep&) = delete;
  StrangStep& operator=(const StrangStep&) = delete;

  Scalar begin() const { return begin_; }
  Scalar length() const { return length_; }
  State<Scalar> end() const { return kicked(to_.state); }
  std::size_t reversals() const { return friction_.reversals(); }

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

  /// What the two kicks miss of the impulse of the friction along the flow: O(length^3 beta), or
  /// O(length beta) where the friction jumps.
  Scalar missed_impulse(Scalar friction_integral) const {
    const Scalar ends = from_.state.friction + to_.state.friction;
    return model_.contact_force(friction_integral - numeric::half(length_) * ends);
  }

  /// Bound of the difference between the velocity of the flow and the path that the contact
  /// follows. At the ends their second derivatives differ by v""' length^3 / 120. Between the ends
  /// the velocities differ by less than a hundredth of that times length^2. Friction that pumps (as
  /// printed) must not turn the sliding by its kick: nothing would bring it back.
  Scalar missed_path() const {
    if constexpr (Law::varies) {
      const auto [begin, end] = velocity_.end_bends();
      const Scalar square = length_ * length_;
      const Scalar bend = numeric::from_real<Scalar>(0.01) *
                          numeric::max(numeric::abs(begin - square * jerk(from_)),
                                       numeric::abs(end - square * jerk(to_)));
      return kick_turns() ? numeric::max(bend, numeric::abs(from_.state.velocity - start_velocity_))
                          : bend;
    }
    return Scalar(0);
  }

  /// The energies of a step; the differences without the cancellation of whole energies.
  struct Gain {
    Scalar kicks;    ///< of the oscillator, from the two kicks
    Scalar kinetic;  ///< from the flow
    Scalar elastic;
  };
  Gain gain() const {
    const State<Scalar>& from = from_.state;
    const State<Scalar>& to = to_.state;
    const Scalar first = model_.contact_force(from.friction) * (start_velocity_ + from.velocity);
    const Scalar last = model_.contact_force(to.friction) * (to.velocity + end().velocity);
    return {-numeric::half(numeric::half(length_)) * (first + last),
            numeric::half(change_.velocity * (from.velocity + to.velocity)),
            numeric::half(model_.stiffness * change_.displacement *
                          (from.displacement + to.displacement))};
  }

  Scalar friction_integral() const { return friction_.integral(Scalar(1), Scalar(0)); }
  Scalar friction_work() const { return friction_.work(); }
  Scalar sliding_work() const {
    return friction_.integral(sliding_at_begin(), interval_.sliding_acceleration);
  }
  MotionIntegrals<Scalar> motion_integrals() const {
    const Scalar velocity_squares = integral(velocity_square(from_), velocity_square(to_));
    return {integral(drive_power(from_), drive_power(to_)), velocity_squares,
            integral(displacement_square(from_), displacement_square(to_)),
            model_.damping_force(velocity_squares)};
  }

 private:
  using Force = decltype(std::declval<typename Flow::Follower>().force());
  using End = FlowEnd<Scalar, Force>;

  State<Scalar> kicked(State<Scalar> state) const {
    state.velocity -= numeric::half(length_) * model_.contact_force(state.friction);
    return state;
  }
  Scalar sliding_at_begin() const {
    return interval_.sliding_velocity +
           Model::Sliding::change(interval_.sliding_acceleration, begin_);
  }
  bool kick_turns() const {
    const Scalar sliding = sliding_at_begin();
    return model_.contact_work(Scalar(1)) < Scalar(0) &&
           model_.contact_velocity(sliding, start_velocity_) *
                   model_.contact_velocity(sliding, from_.state.velocity) <
               Scalar(0);
  }
  End flow_end(const State<Scalar>& state, const typename Flow::Follower& drive) const {
    const Force force = drive.force();
    const State<Scalar> free = {state.displacement, state.velocity, Scalar(0)};
    return {state, force, model_.acceleration(force.value, free)};
  }

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
    const Force& force = end.drive;
    return {force.value * velocity, force.value * end.acceleration + force.slope * velocity,
            force.bent(jerk(end), velocity) + numeric::twice(force.slope * end.acceleration)};
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
  const IntervalOf<Model>& interval_;
  Scalar begin_;
  Scalar length_;
  Scalar start_velocity_;
  End from_;
  Motion<Scalar> change_;
  End to_;
  VelocityPath<Scalar> velocity_;
  VelocityPath<Scalar> sliding_;
  FrictionArcs<Law> friction_;
};

// A step of the splitting method with two measures of its error.

/// The step as an account sees it, its integrals computed once, and two defects of it:
///   velocity  what the kicks miss of the impulse of friction along the flow, or the path that the
///             contact is led along misses of the flow
///   energy    what the balance of the step, as the account will have it, leaves over:
///             gain of the oscillator - drive work + damping work + sigma beta (friction work -
///             sliding work)
template <class Model>
class MeasuredStrangStep {
 public:
  using Scalar = typename Model::Scalar;

  MeasuredStrangStep(const Model& model, const StrangStep<Model>& step)
      : step_(step),
        friction_integral_(step.friction_integral()),
        friction_work_(step.friction_work()),
        sliding_work_(step.sliding_work()),
        motion_(step.motion_integrals()),
        gain_(step.gain()),
        contact_scale_(model.contact_work(Scalar(1))) {}

  Scalar begin() const { return step_.begin(); }
  Scalar length() const { return step_.length(); }
  State<Scalar> at(Scalar offset) const { return step_.at(offset); }
  Scalar friction_integral() const { return friction_integral_; }
  Scalar friction_work() const { return friction_work_; }
  Scalar sliding_work() const { return sliding_work_; }
  const MotionIntegrals<Scalar>& motion_integrals() const { return motion_; }

  Scalar velocity_defect() const {
    return numeric::max(numeric::abs(step_.missed_impulse(friction_integral_)),
                        step_.missed_path());
  }
  Scalar energy_defect() const {
    return numeric::abs(
        (gain_.kicks + contact_work()) +
        ((gain_.kinetic + gain_.elastic) - (motion_.drive_work - motion_.damping_work)));
  }
  /// The largest energy that drive, damper or contact passed on.
  Scalar passed_energy() const {
    return numeric::max(
        numeric::max(numeric::abs(motion_.drive_work), numeric::abs(motion_.damping_work)),
        numeric::abs(contact_work()));
  }
  /// What rounding is relative to in energy_defect().
  Scalar energy_terms() const {
    return numeric::abs(gain_.kicks) + numeric::abs(gain_.kinetic) + numeric::abs(gain_.elastic) +
           numeric::abs(motion_.drive_work) + numeric::abs(motion_.damping_work) +
           numeric::abs(contact_scale_) *
               (numeric::abs(friction_work_) + numeric::abs(sliding_work_));
  }

 private:
  Scalar contact_work() const { return contact_scale_ * (friction_work_ - sliding_work_); }

  const StrangStep<Model>& step_;
  Scalar friction_integral_;
  Scalar friction_work_;
  Scalar sliding_work_;
  MotionIntegrals<Scalar> motion_;
  typename StrangStep<Model>::Gain gain_;
  Scalar contact_scale_;  ///< sigma beta
};

}  // namespace sonoglide::plant
