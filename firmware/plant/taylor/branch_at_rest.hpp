/// Which way a contact goes on from V = 0: it slides one way or the other, or it sticks.
#pragma once

#include <cstddef>

#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/taylor/step_friction.hpp"
#include "firmware/plant/taylor/taylor_series.hpp"

namespace sonoglide::plant {

/// What the contact does from an instant on at which V = 0.
template <class Scalar>
struct Branch {
  bool sticks;
  /// Sliding: sgn V; 0 where V stays zero. Sticking: the side on which |phi| = 1 already, or 0.
  Scalar direction;
  /// Multiplicity of the zero, at the beginning, of V (sliding) or of 1 - direction phi (sticking).
  std::size_t zero_order;
};

/// Chooses the branch by the first derivative of V that exceeds its rounding error.
template <class Model, std::size_t Order>
class BranchAtRest {
 public:
  using Scalar = typename Model::Scalar;

  BranchAtRest(const Model& model, const InstantOf<Model>& instant)
      : model_(model), instant_(instant) {}

  /// released: the direction in which friction has just reached its limit, 0 if it has not.
  Branch<Scalar> choose(Scalar released) const {
    State<Scalar> at_rest = instant_.state;
    at_rest.friction = model_.law.friction(Scalar(0), contact_memory(instant_.state));
    const Scalar acceleration =
        model_.contact_velocity(sliding_acceleration(at_rest.friction),
                                model_.acceleration(instant_.drive.value(), at_rest));
    const Scalar error = noise(instant_.drive.bound(), at_rest) +
                         model_.damping_force(instant_.rest_error) +
                         sliding_error(at_rest.friction);
    if constexpr (Model::FrictionLaw::sticks) {
      if (model_.vibration_sign > Scalar(0) && model_.holding_acceleration() > error) {
        return stick_or_slip(acceleration, error, released);
      }
    }
    if (numeric::abs(acceleration) > error) {
      return {false, numeric::sign(acceleration), 1};
    }
    return by_higher_derivatives();
  }

 private:
  using Series = TaylorSeries<Model, Order>;
  using Arc = typename SlidingLaw<typename Model::FrictionLaw, Order>::Type;

  /// r', of a load with the friction on it.
  Scalar sliding_acceleration(Scalar friction) const {
    if constexpr (Model::Sliding::moves) {
      return instant_.sliding_acceleration - model_.load_friction(friction);
    } else {
      return instant_.sliding_acceleration;
    }
  }
  /// Its rounding.
  Scalar sliding_error(Scalar friction) const {
    if constexpr (Model::Sliding::moves) {
      return instant_.acceleration_error +
             instant_.relative_error * numeric::abs(model_.load_friction(friction));
    } else {
      return instant_.relative_error * numeric::abs(instant_.sliding_acceleration);
    }
  }

  Scalar noise(Scalar drive, const State<Scalar>& state) const {
    return instant_.relative_error * model_.force_moduli(drive, state);
  }

  Branch<Scalar> stick_or_slip(Scalar acceleration, Scalar error, Scalar released) const {
    const Scalar holding = model_.holding_acceleration();
    const Scalar excess = numeric::abs(acceleration) - holding;
    const Scalar limit = error + instant_.relative_error * holding;
    if (released == Scalar(0) && excess < -limit) {
      return {true, Scalar(0), 0};
    }
    if (released == Scalar(0) && excess > limit) {
      return {false, numeric::sign(acceleration), 1};
    }
    const Scalar direction = released == Scalar(0) ? numeric::sign(acceleration) : released;
    const Leading leading = leading_coefficient(direction);
    if (leading.order <= Order && direction * leading.value > Scalar(0)) {
      return {false, direction, leading.order};
    }
    return {true, direction, leading.order - 1};
  }

  /// The first derivative of V that is not zero does not depend on the direction of sliding.
  Branch<Scalar> by_higher_derivatives() const {
    const Leading leading = leading_coefficient(Scalar(0));
    const Scalar direction = leading.order <= Order ? numeric::sign(leading.value) : Scalar(0);
    if constexpr (Model::FrictionLaw::sticks) {
      return {false, direction, leading_coefficient(direction).order};
    }
    return {false, direction, leading.order};
  }

  struct Leading {
    std::size_t order;  ///< Order + 1 if every coefficient is zero within rounding
    Scalar value;
  };

  /// A running bound of the rounding errors of r: what they add to those of V.
  class LoadError {
   public:
    Scalar next(const BranchAtRest& branch, const Series& series, std::size_t n) {
      const Model& model = branch.model_;
      const Scalar terms = numeric::abs(n < 2 ? series.load_force[n] : Scalar(0)) +
                           model.load_damping * numeric::abs(series.sliding_velocity[n]) +
                           model.load_stiffness * numeric::abs(series.extension[n]) +
                           numeric::abs(model.load_friction(series.friction[n]));
      const Scalar factor = numeric::reciprocal<Scalar>(n + 1);
      const Scalar inherited = model.load_damping * velocity_ + model.load_stiffness * extension_;
      extension_ = factor * velocity_;
      velocity_ = factor * (inherited + branch.instant_.relative_error * terms);
      return velocity_;
    }

   private:
    Scalar velocity_ = Scalar(0);
    Scalar extension_ = Scalar(0);
  };

  /// The first coefficient of V, x^0 apart, beyond a running bound of the rounding errors.
  [[gnu::noinline]] Leading leading_coefficient(Scalar direction) const {
    Series series(model_, instant_, Scalar(1));
    Arc arc(model_.law, direction, contact_memory(instant_.state));
    series.slide(model_, arc);
    Scalar drive = instant_.drive.bound();
    Scalar displacement_error = instant_.relative_error * numeric::abs(series.displacement);
    Scalar velocity_error = instant_.rest_error;
    Scalar pull_error = sliding_error(series.friction[0]);
    LoadError load;
    for (std::size_t n = 0; n < Order; ++n) {
      const Scalar inherited = model_.damping_force(velocity_error) +
                               numeric::abs(model_.stiffness) * displacement_error;
      const Scalar factor = numeric::reciprocal<Scalar>(n + 1);
      const State<Scalar> terms = series.state_coefficients(n);
      displacement_error = factor * velocity_error;
      velocity_error = factor * (inherited + noise(drive, terms) + pull_error);
      pull_error = Scalar(0);
      if constexpr (Model::Sliding::moves) {
        velocity_error += load.next(*this, series, n);
      }
      drive *= factor;
      if (numeric::abs(series.travel[n + 1]) > velocity_error) {
        return {n + 1, series.travel[n + 1]};
      }
    }
    return {Order + 1, Scalar(0)};
  }

  const Model& model_;
  const InstantOf<Model>& instant_;
};

}  // namespace sonoglide::plant
