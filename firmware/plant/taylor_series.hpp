/// Power series of the motion about one instant, the direction of sliding being fixed.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "firmware/plant/polynomial.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// The plant and what acts on it at one instant.
template <class Model>
struct Instant {
  using Scalar = typename Model::Scalar;

  typename Model::Drive::template Phasor<Scalar> drive;
  Scalar sliding_velocity;
  Scalar sliding_acceleration;
  Scalar relative_error;  ///< rounding of the terms of the motion, that of time included
  Scalar rest_error;      ///< rounding of the velocity at which V = 0
  State<Scalar> state;
};

/// Taylor coefficients in x = (tau - tau0) / unit, up to x^Order.
template <class Model, std::size_t Order>
struct TaylorSeries {
  using Scalar = typename Model::Scalar;
  using Coefficients = std::array<Scalar, Order + 1>;
  using DriveSeries = typename Model::Drive::template Series<Scalar, Order>;

  Scalar unit;
  DriveSeries drive;
  std::array<Scalar, 2> sliding_velocity;  ///< r
  Coefficients displacement;
  Coefficients velocity;
  Coefficients contact_velocity;  ///< V
  Coefficients friction;

  TaylorSeries(const Instant<Model>& instant, Scalar series_unit)
      : unit(series_unit),
        drive(instant.drive, series_unit),
        sliding_velocity{instant.sliding_velocity, instant.sliding_acceleration * series_unit} {
    displacement[0] = instant.state.displacement;
    velocity[0] = instant.state.velocity;
  }

  /// The contact slides along an arc of its friction law.
  template <class Arc>
  void slide(const Model& model, Arc& arc) {
    slide(model, arc, std::make_index_sequence<Order>());
    solve_contact(model, arc, Order);
  }

  /// The contact holds, V = 0, by whatever friction that takes.
  void stick(const Model& model) {
    displacement = {displacement[0]};
    velocity = {velocity[0], model.resting_velocity(sliding_velocity[1])};
    contact_velocity = {};
    displacement[1] = unit * velocity[0];
    displacement[2] = unit * velocity[1] / Scalar(2);
    for (std::size_t n = 0; n <= Order; ++n) {
      const Scalar free = model.acceleration(drive[n], {displacement[n], velocity[n], Scalar(0)});
      const Scalar followed = n == 0 ? velocity[1] / unit : Scalar(0);
      friction[n] = (free - followed) / model.friction_force;
    }
  }

 private:
  /// Unrolled: the sums over earlier terms are short, of known length, and overlap.
  template <class Arc, std::size_t... Terms>
  void slide(const Model& model, Arc& arc, std::index_sequence<Terms...> /*terms*/) {
    (add_term(model, arc, Terms), ...);
  }

  template <class Arc>
  void add_term(const Model& model, Arc& arc, std::size_t n) {
    solve_contact(model, arc, n);
    const Scalar factor = unit * reciprocal<Scalar>(n + 1);
    velocity[n + 1] =
        factor * model.acceleration(drive[n], {displacement[n], velocity[n], friction[n]});
    displacement[n + 1] = factor * velocity[n];
  }
  template <class Arc>
  void solve_contact(const Model& model, Arc& arc, std::size_t n) {
    contact_velocity[n] =
        model.contact_velocity(n < 2 ? sliding_velocity[n] : Scalar(0), velocity[n]);
    friction[n] = arc.coefficient(n, unit * reciprocal<Scalar>(n), contact_velocity);
  }
};

}  // namespace sonoglide::plant
