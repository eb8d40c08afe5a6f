/// The classical Runge–Kutta formula of fourth order for the plant.
#pragma once

#include <array>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/rk4/rk4_step.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// The law as it stands: its rate changes with sgn V wherever V changes sign.
struct TurningContact {
  template <class Law, class Velocity, class Scalar>
  Scalar friction(const Law& law, const Velocity& velocity, Scalar friction) const {
    return law.friction(velocity, friction);
  }
  template <class Law, class Velocity, class Scalar>
  Scalar rate(const Law& law, const Velocity& velocity, Scalar friction) const {
    return law.rate(velocity, friction);
  }
};

/// The law with sgn V frozen: smooth, and continued smoothly a little beyond a reversal.
template <class Scalar>
struct FrozenContact {
  Scalar direction;  ///< sgn V; 0 holds the friction where it is

  template <class Law>
  Scalar friction(const Law& /*law*/, Scalar /*velocity*/, Scalar friction) const {
    return friction;
  }
  /// d phi / d tau is proportional to V.
  template <class Law>
  Scalar rate(const Law& law, Scalar velocity, Scalar friction) const {
    return direction * velocity * law.rate(direction, friction);
  }
};

/// The drive force where the formula needs it.
template <class Scalar>
struct Rk4Drive {
  Scalar begin;
  Scalar middle;
  Scalar end;
};

/// The four stages of a step, and the plant at its end. The classical method of fourth order:
///
///        0  |
///       1/2 | 1/2
///       1/2 |  0   1/2
///        1  |  0    0    1
///       ----+-------------------
///           | 1/6  1/3  1/3  1/6
///
/// Source: Hairer 1993, II.1, Table 1.2 (../README.md).
template <class Scalar, class StateType = State<Scalar>>
struct Rk4Stages {
  std::array<Rk4Stage<Scalar, StateType>, 4> inside;
  Rk4Stage<Scalar, StateType> end;
};

/// One interval as the formula sees it; ContactSense is TurningContact or FrozenContact.
template <class Model, class ContactSense>
class Rk4Formula {
 public:
  using Scalar = typename Model::Scalar;
  using PlantState = typename Model::PlantState;
  using Stage = Rk4Stage<Scalar, PlantState>;
  using Stages = Rk4Stages<Scalar, PlantState>;

  Rk4Formula(const Model& model, const IntervalOf<Model>& interval, ContactSense contact)
      : model_(model), interval_(interval), contact_(contact) {}

  /// The plant at one instant.
  Stage stage(Scalar drive, Scalar offset, PlantState state) const {
    const Scalar given =
        interval_.sliding_velocity + Model::Sliding::change(interval_.sliding_acceleration, offset);
    const Scalar sliding = sliding_velocity(given, state);
    const auto velocity = model_.contact_velocity(sliding, state.velocity);
    state.friction = contact_.friction(model_.law, velocity, contact_memory(state));
    PlantState slope;
    contact_memory(slope) = contact_.rate(model_.law, velocity, contact_memory(state));
    slope.displacement = state.velocity;
    slope.velocity = model_.acceleration(
        drive, {state.displacement, state.velocity,
                model_.friction_on_oscillator(sliding, state.velocity, state.friction)});
    if constexpr (Model::Sliding::moves) {
      const Scalar force = interval_.load_force + interval_.load_force_rate * offset;
      slope.sliding_velocity = model_.free_load_acceleration(force, sliding, state.extension) -
                               model_.load_friction(state.friction);
      slope.extension = sliding - given;
    }
    return {drive, sliding, state, slope};
  }

  /// A step from the stage at its beginning.
  Stages stages(const Stage& begin, const Rk4Drive<Scalar>& drive, Scalar offset,
                Scalar length) const {
    const PlantState& from = begin.state;
    const Scalar half = length / Scalar(2);
    Stages taken;
    auto& k = taken.inside;
    // k1 = f(t, y), k2 = f(t + h/2, y + h/2 k1), k3 = f(t + h/2, y + h/2 k2), k4 = f(t + h, y + h k3)
    k[0] = begin;
    k[1] = stage(drive.middle, offset + half, moved(from, k[0].slope, half));
    k[2] = stage(drive.middle, offset + half, moved(from, k[1].slope, half));
    k[3] = stage(drive.end, offset + length, moved(from, k[2].slope, length));
    // y + h (k1 + 2 k2 + 2 k3 + k4)/6
    PlantState slope;
    slope.displacement = mean(k, [](const PlantState& rate) { return rate.displacement; });
    slope.velocity = mean(k, [](const PlantState& rate) { return rate.velocity; });
    contact_memory(slope) = mean(k, [](const PlantState& rate) { return contact_memory(rate); });
    if constexpr (Model::Sliding::moves) {
      slope.sliding_velocity =
          mean(k, [](const PlantState& rate) { return rate.sliding_velocity; });
      slope.extension = mean(k, [](const PlantState& rate) { return rate.extension; });
    }
    taken.end = stage(drive.end, offset + length, moved(from, slope, length));
    return taken;
  }

 private:
  /// Of the body: what the interval gives, or its own.
  static Scalar sliding_velocity(Scalar given, const PlantState& state) {
    if constexpr (Model::Sliding::moves) {
      return state.sliding_velocity;
    } else {
      return given;
    }
  }

  static PlantState moved(PlantState from, const PlantState& slope, Scalar time) {
    from.displacement += time * slope.displacement;
    from.velocity += time * slope.velocity;
    contact_memory(from) += time * contact_memory(slope);
    if constexpr (Model::Sliding::moves) {
      from.sliding_velocity += time * slope.sliding_velocity;
      from.extension += time * slope.extension;
    }
    return from;
  }

  /// The method's mean of one component of the slopes.
  template <class Component>
  static Scalar mean(const std::array<Stage, 4>& k, const Component& of) {
    constexpr Scalar sixth = numeric::from_real<Scalar>(1.0 / 6.0);
    return sixth *
           (of(k[0].slope) + Scalar(2) * (of(k[1].slope) + of(k[2].slope)) + of(k[3].slope));
  }

  const Model& model_;
  const IntervalOf<Model>& interval_;
  ContactSense contact_;
};

}  // namespace sonoglide::plant
