/// One step of the classical Runge–Kutta method: the motion inside it, and its integrals.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// The plant at one of the four stages of a step.
template <class Scalar, class StateType = State<Scalar>>
struct Rk4Stage {
  Scalar drive = Scalar(0);             ///< a cos(tau)
  Scalar sliding_velocity = Scalar(0);  ///< r
  StateType state;                      ///< friction as the law gives it at this velocity
  StateType slope;                      ///< d state / d tau, of phi where the law goes on from it
};

/// The step's integrals are those that the method gives for additional states. Between the ends the
/// state is the cubic that has their values and slopes (Hairer 1993, II.6). |phi| is cut off at 1,
/// unless the law depends on the speed.
template <class Model>
class Rk4Step {
 public:
  using Scalar = typename Model::Scalar;
  using Law = typename Model::FrictionLaw;
  using PlantState = typename Model::PlantState;
  using Stage = Rk4Stage<Scalar, PlantState>;

  /// end_stage: the plant at the end of the step.
  Rk4Step(const Model& model, const std::array<Stage, 4>& stages, const Stage& end_stage,
          Scalar begin, Scalar length)
      : model_(model), stages_(stages), end_(end_stage), begin_(begin), length_(length) {}

  Scalar begin() const { return begin_; }
  Scalar length() const { return length_; }

  typename Model::Motion at(Scalar offset) const {
    const Scalar x = offset / length_;
    const PlantState& from = stages_[0].state;
    const PlantState& from_slope = stages_[0].slope;
    const Scalar velocity =
        cubic(from.velocity, from_slope.velocity, end_.state.velocity, end_.slope.velocity, x);
    const Scalar memory = cubic(contact_memory(from), contact_memory(from_slope),
                                contact_memory(end_.state), contact_memory(end_.slope), x);
    Scalar sliding_velocity =
        stages_[0].sliding_velocity + (end_.sliding_velocity - stages_[0].sliding_velocity) * x;
    if constexpr (Model::Sliding::moves) {
      sliding_velocity = cubic(from.sliding_velocity, from_slope.sliding_velocity,
                               end_.state.sliding_velocity, end_.slope.sliding_velocity, x);
    }
    const Scalar friction =
        model_.law.friction(model_.contact_velocity(sliding_velocity, velocity), memory);
    const State<Scalar> oscillator = {
        cubic(from.displacement, from_slope.displacement, end_.state.displacement,
              end_.slope.displacement, x),
        velocity,
        Law::rate_independent ? numeric::clamp(friction, Scalar(-1), Scalar(1)) : friction};
    if constexpr (Model::Sliding::moves) {
      return {oscillator, sliding_velocity,
              cubic(from.extension, from_slope.extension, end_.state.extension,
                    end_.slope.extension, x)};
    } else {
      return oscillator;
    }
  }

  Scalar friction_integral() const {
    return sum([](const Stage& stage) { return stage.state.friction; });
  }
  Scalar friction_work() const {
    return sum([this](const Stage& stage) {
      return model_.friction_power(stage.sliding_velocity, stage.state.velocity,
                                   stage.state.friction);
    });
  }
  Scalar sliding_work() const {
    return sum([](const Stage& stage) { return stage.state.friction * stage.sliding_velocity; });
  }
  MotionIntegrals<Scalar> motion_integrals() const {
    MotionIntegrals<Scalar> sum;
    const Scalar sixth = length_ / Scalar(6);
    add(stages_[0], sixth, sum);
    add(stages_[1], numeric::twice(sixth), sum);
    add(stages_[2], numeric::twice(sixth), sum);
    add(stages_[3], sixth, sum);
    sum.damping_work = model_.damping_force(sum.velocity_square);
    return sum;
  }
  /// Of a load. What acts on it follows from the slopes of the stages.
  LoadIntegrals<Scalar> load_integrals() const {
    LoadIntegrals<Scalar> sum;
    const Scalar sixth = length_ / Scalar(6);
    sum.add(load_powers(stages_[0]), sixth);
    sum.add(load_powers(stages_[1]), numeric::twice(sixth));
    sum.add(load_powers(stages_[2]), numeric::twice(sixth));
    sum.add(load_powers(stages_[3]), sixth);
    return sum;
  }

 private:
  template <class Integrand>
  Scalar sum(const Integrand& f) const {
    return length_ / Scalar(6) *
           (f(stages_[0]) + Scalar(2) * (f(stages_[1]) + f(stages_[2])) + f(stages_[3]));
  }

  LoadIntegrals<Scalar> load_powers(const Stage& stage) const {
    const PlantState& state = stage.state;
    const Scalar velocity = state.sliding_velocity;
    const Scalar force = stage.slope.sliding_velocity + model_.load_friction(state.friction) -
                         model_.free_load_acceleration(Scalar(0), velocity, state.extension);
    const Scalar pulled = velocity - stage.slope.extension;
    return {force * velocity, -model_.load_stiffness * state.extension * pulled,
            velocity * velocity};
  }

  static void add(const Stage& stage, Scalar weight, MotionIntegrals<Scalar>& sum) {
    sum.add(weight, stage.drive, stage.state.displacement, stage.state.velocity);
  }

  Scalar cubic(Scalar from, Scalar from_slope, Scalar to, Scalar to_slope, Scalar x) const {
    const Scalar rise = to - from;
    const Scalar bend_from = length_ * from_slope - rise;
    const Scalar bend_to = length_ * to_slope - rise;
    const Scalar rest = Scalar(1) - x;
    return from + x * (rise + rest * (rest * bend_from - x * bend_to));
  }

  const Model& model_;
  const std::array<Stage, 4>& stages_;
  const Stage& end_;
  Scalar begin_;
  Scalar length_;
};

}  // namespace sonoglide::plant
