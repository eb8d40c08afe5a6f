/// Power series of the motion about one instant, the direction of sliding being fixed.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/power_series.hpp"
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
  StateOf<typename Model::FrictionLaw> state;
};

/// Taylor coefficients in x = (tau - tau0) / unit, seen from the contact: of the force up to
/// x^Order, and so of the velocity up to one power more.
///
/// Travel u = integral of V: du/dx = unit (r + sigma v). The vibration's share of it obeys
///   w' = sigma unit^2 (a cos - k y - beta phi) - d unit w,   w = sigma unit v,
/// so that above x^1, where the sliding ends, one set of coefficients serves contact and
/// oscillator.
template <class Model, std::size_t Order>
struct TaylorSeries {
  using Scalar = typename Model::Scalar;
  static constexpr std::size_t order = Order;
  using Coefficients = std::array<Scalar, Order + 1>;
  using Motion = std::array<Scalar, Order + 2>;
  using DriveSeries = typename Model::Drive::template Series<Scalar, Order>;

  Scalar unit;
  Scalar side;  ///< sigma
  Scalar rate;  ///< sigma / unit: from w to v
  DriveSeries drive;
  std::array<Scalar, 2> sliding_velocity;  ///< r
  Scalar displacement;                     ///< y at x = 0
  Scalar velocity;                         ///< v there
  std::array<Scalar, 2> vibration;         ///< w; beyond x^1 it is travel
  Motion travel;                           ///< du/dx
  Motion shift;                            ///< w / (n + 1): of the displacement, x apart
  Coefficients friction;                   ///< phi

  TaylorSeries(const Model& model, const Instant<Model>& instant, Scalar series_unit)
      : unit(series_unit),
        side(model.side()),
        rate(side / unit),
        drive(instant.drive, series_unit),
        sliding_velocity{instant.sliding_velocity,
                         Model::Sliding::change(instant.sliding_acceleration, series_unit)},
        displacement(instant.state.displacement),
        velocity(instant.state.velocity) {
    vibration[0] = side * unit * velocity;
    travel[0] = unit * model.path_velocity(sliding_velocity[0], velocity);
  }

  /// The contact slides along an arc of its friction law.
  template <class Arc>
  [[gnu::always_inline]] void slide(const Model& model, Arc& arc) {
    slide(model, arc, std::make_index_sequence<Order + 1>());
  }

  /// The contact sticks: V = 0, and phi is the friction that holds it.
  void stick(const Model& model) {
    vibration = {-unit * sliding_velocity[0], -unit * sliding_velocity[1]};
    travel = {};
    shift = {vibration[0], numeric::half(vibration[1])};
    for (std::size_t n = 0; n <= Order; ++n) {
      const State<Scalar> state = state_coefficients(n);
      const Scalar followed =
          n == 0 ? model.resting_velocity(sliding_velocity[1]) / unit : Scalar(0);
      const Scalar free =
          model.acceleration(drive[n], {state.displacement, state.velocity, Scalar(0)});
      friction[n] = (free - followed) / model.friction_force;
    }
  }

  /// The n-th coefficients of y, v and phi.
  State<Scalar> state_coefficients(std::size_t n) const {
    const Scalar position = n == 0 ? displacement : side * shift[n - 1];
    return {position, rate * motion(n), friction[n]};
  }

  /// y and v at x, from 0 to where the series serves.
  Scalar displacement_at(Scalar x) const {
    return displacement +
           side * (x * (shift[0] + x * (shift[1] + x * numeric::evaluate_from<2>(shift, x))));
  }
  Scalar velocity_at(Scalar x) const {
    return velocity + rate * (x * (vibration[1] + x * numeric::evaluate_from<2>(travel, x)));
  }

  /// du/dx at x.
  Scalar travel_rate(Scalar x) const {
    return travel[0] + x * (travel[1] + x * numeric::evaluate_from<2>(travel, x));
  }

  /// u(x) - u(0). The sliding and the vibration are added before they are multiplied: they may
  /// cancel.
  Scalar travelled(Scalar x) const {
    return x * ((travel[0] + x * numeric::half(travel[1])) +
                (x * x) * numeric::evaluate_from<2>(shift, x));
  }

  /// False if a coefficient has overflowed.
  bool is_finite() const {
    return numeric::is_finite(travel[Order + 1]) && numeric::is_finite(friction[Order]);
  }

  Scalar motion(std::size_t n) const { return n < 2 ? vibration[n] : travel[n]; }

 private:
  /// Unrolled: the sums over earlier terms are short, of known length, and overlap.
  template <class Arc, std::size_t... Terms>
  [[gnu::always_inline]] void slide(const Model& model, Arc& arc,
                                    std::index_sequence<Terms...> /*terms*/) {
    (add_term<Terms>(model, arc), ...);
    shift[Order] = numeric::reciprocal<Scalar>(Order + 1) * travel[Order];
    shift[Order + 1] = numeric::reciprocal<Scalar>(Order + 2) * travel[Order + 1];
  }

  template <std::size_t N, class Arc>
  [[gnu::always_inline]] Scalar friction_coefficient(Arc& arc) const {
    using Law = typename Model::FrictionLaw;
    if constexpr (Law::vibration == friction::Vibration::across) {
      return arc.template coefficient<N>(rate * motion(N), N < 2 ? sliding_velocity[N] : Scalar(0));
    } else if constexpr (Law::rate_independent) {
      return arc.template coefficient<N>(travel, friction);
    } else {
      return arc.template coefficient<N>(travel, unit);
    }
  }

  template <std::size_t N, class Arc>
  [[gnu::always_inline]] void add_term(const Model& model, Arc& arc) {
    friction[N] = friction_coefficient<N>(arc);
    const Scalar square = unit * unit;
    const Scalar force_factor = side * square;
    Scalar spring = force_factor * model.stiffness * displacement;
    if constexpr (N > 0) {
      shift[N - 1] = numeric::reciprocal<Scalar>(N) * motion(N - 1);
      spring = (square * model.stiffness) * shift[N - 1];
    }
    const Scalar free =
        drive.term(N, force_factor) - spring - model.damping_force(unit * motion(N));
    // Friction, the newest, enters last, and by one product.
    const Scalar integrated = numeric::reciprocal<Scalar>(N + 1);
    Scalar next = integrated * free;
    if constexpr (N == 0 || Model::FrictionLaw::varies) {
      next -= (integrated * model.contact_force(force_factor)) * friction[N];
    }
    if constexpr (N == 0) {
      vibration[1] = next;
      travel[1] = next + Model::Sliding::change(model.path_share(sliding_velocity[1]), unit);
    } else {
      travel[N + 1] = next;
    }
  }
};

}  // namespace sonoglide::plant
