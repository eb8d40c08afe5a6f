/// Power series of the motion about one instant, the direction of sliding being fixed.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
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
  typename Model::PlantState state;
};

/// The same with a load. The sliding acceleration is that which friction leaves out.
template <class Model>
struct LoadedInstant : Instant<Model> {
  using Scalar = typename Model::Scalar;

  Scalar load_force;  ///< fa
  Scalar load_force_rate;
  Scalar pull_velocity;  ///< vp
  Scalar pull_acceleration;
  Scalar acceleration_error;  ///< rounding of the sliding acceleration
};

template <class Model>
using InstantOf = std::conditional_t<Model::Sliding::moves, LoadedInstant<Model>, Instant<Model>>;

/// What a series has more with a load, whose r, z and V it expands; nothing without one.
template <class Model, std::size_t Order, bool Moves = Model::Sliding::moves>
struct LoadTerms {
  /// Highest power of r.
  static constexpr std::size_t sliding_count = 2;
  static constexpr std::size_t vibration_count = 2;
};
template <class Model, std::size_t Order>
struct LoadTerms<Model, Order, true> {
  using Scalar = typename Model::Scalar;
  static constexpr std::size_t sliding_count = Order + 2;
  static constexpr std::size_t vibration_count = Order + 2;

  std::array<Scalar, 2> load_force;         ///< fa
  std::array<Scalar, 2> pull_velocity;      ///< vp
  std::array<Scalar, Order + 2> extension;  ///< z
  std::array<Scalar, Order + 2> distance;   ///< du/dx / (n + 1): of the travel, x apart
};

/// Taylor coefficients in x = (tau - tau0) / unit, seen from the contact: of the force up to
/// x^Order, and so of the velocity up to one power more.
///
/// Travel u = integral of V: du/dx = unit (r + sigma v). The vibration's share of it obeys
///   w' = sigma unit^2 (a cos - k y - beta phi) - d unit w,   w = sigma unit v,
/// so that above x^1, where the sliding ends, one set of coefficients serves contact and
/// oscillator. With a load r goes on, and each has its own.
template <class Model, std::size_t Order>
struct TaylorSeries : LoadTerms<Model, Order> {
  using Scalar = typename Model::Scalar;
  static constexpr std::size_t order = Order;
  using Coefficients = std::array<Scalar, Order + 1>;
  using Motion = std::array<Scalar, Order + 2>;
  using Extra = LoadTerms<Model, Order>;
  static constexpr bool moves = Model::Sliding::moves;
  using DriveSeries = typename Model::Drive::template Series<Scalar, Order>;

  Scalar unit;
  Scalar side;  ///< sigma
  Scalar rate;  ///< sigma / unit: from w to v
  DriveSeries drive;
  std::array<Scalar, Extra::sliding_count> sliding_velocity;  ///< r
  Scalar displacement;                                        ///< y at x = 0
  Scalar velocity;                                            ///< v there
  std::array<Scalar, Extra::vibration_count> vibration;       ///< w; beyond these it is travel
  Motion travel;                                              ///< du/dx
  Motion shift;           ///< w / (n + 1): of the displacement, x apart
  Coefficients friction;  ///< phi

  TaylorSeries(const Model& model, const InstantOf<Model>& instant, Scalar series_unit)
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
    if constexpr (moves) {
      this->load_force = {instant.load_force, instant.load_force_rate * unit};
      this->pull_velocity = {instant.pull_velocity, instant.pull_acceleration * unit};
      this->extension[0] = instant.state.extension;
    }
  }

  /// The contact slides along an arc of its friction law.
  template <class Arc>
  [[gnu::always_inline]] void slide(const Model& model, Arc& arc) {
    slide(model, arc, std::make_index_sequence<Order + 1>());
  }

  /// The contact sticks: V = 0, and phi is the friction that holds it.
  void stick(const Model& model) {
    if constexpr (moves) {
      stick_with_load(model);
    } else {
      stick_to_given_motion(model);
    }
  }

  /// The n-th coefficients of y, v and phi.
  State<Scalar> state_coefficients(std::size_t n) const {
    const Scalar position = n == 0 ? displacement : side * shift[n - 1];
    return {position, rate * motion(n), friction[n]};
  }

  /// r' but for friction: its n-th coefficient over n + 1, in x.
  Scalar free_load_term(const Model& model, std::size_t n) const {
    return model.free_load_acceleration(n < 2 ? this->load_force[n] : Scalar(0),
                                        sliding_velocity[n], this->extension[n]);
  }

  /// y and v at x, from 0 to where the series serves.
  Scalar displacement_at(Scalar x) const {
    return displacement +
           side * (x * (shift[0] + x * (shift[1] + x * numeric::evaluate_from<2>(shift, x))));
  }
  Scalar velocity_at(Scalar x) const {
    return velocity + rate * (x * (vibration[1] + x * numeric::evaluate_from<2>(motions(), x)));
  }
  /// r at x.
  Scalar sliding_velocity_at(Scalar x) const { return numeric::evaluate(sliding_velocity, x); }

  /// du/dx at x.
  Scalar travel_rate(Scalar x) const {
    return travel[0] + x * (travel[1] + x * numeric::evaluate_from<2>(travel, x));
  }

  /// u(x) - u(0). The sliding and the vibration are added before they are multiplied: they may
  /// cancel.
  Scalar travelled(Scalar x) const {
    return x * ((travel[0] + x * numeric::half(travel[1])) +
                (x * x) * numeric::evaluate_from<2>(distances(), x));
  }

  /// False if a coefficient has overflowed.
  bool is_finite() const {
    return numeric::is_finite(travel[Order + 1]) && numeric::is_finite(friction[Order]);
  }

  Scalar motion(std::size_t n) const {
    return n < Extra::vibration_count ? vibration[n] : travel[n];
  }
  /// w, from x^2 on.
  const Motion& motions() const {
    if constexpr (moves) {
      return vibration;
    } else {
      return travel;
    }
  }
  /// du/dx / (n + 1), from x^2 on.
  const Motion& distances() const {
    if constexpr (moves) {
      return this->distance;
    } else {
      return shift;
    }
  }

 private:
  void stick_to_given_motion(const Model& model) {
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

  /// Both masses move as one.
  void stick_with_load(const Model& model) {
    travel = {};
    this->distance = {};
    const Scalar both = Scalar(1) + model.mass_ratio;
    vibration[0] = -unit * sliding_velocity[0];
    for (std::size_t n = 0; n <= Order; ++n) {
      if (n > 0) {
        shift[n - 1] = numeric::reciprocal<Scalar>(n) * vibration[n - 1];
        extend(n);
      }
      const State<Scalar> state = state_coefficients(n);
      const Scalar free =
          model.acceleration(drive[n], {state.displacement, state.velocity, Scalar(0)});
      const Scalar load = free_load_term(model, n);
      friction[n] = (free + load) / model.holding_acceleration();
      sliding_velocity[n + 1] =
          (numeric::reciprocal<Scalar>(n + 1) * unit) * ((load - model.mass_ratio * free) / both);
      vibration[n + 1] = -unit * sliding_velocity[n + 1];
    }
    shift[Order] = numeric::reciprocal<Scalar>(Order + 1) * vibration[Order];
    shift[Order + 1] = numeric::reciprocal<Scalar>(Order + 2) * vibration[Order + 1];
    extend(Order + 1);
  }

  /// The n-th coefficient of z, n > 0.
  void extend(std::size_t n) {
    const Scalar pulled = n < 3 ? this->pull_velocity[n - 1] : Scalar(0);
    this->extension[n] =
        (numeric::reciprocal<Scalar>(n) * unit) * (sliding_velocity[n - 1] - pulled);
  }

  /// Unrolled: the sums over earlier terms are short, of known length, and overlap.
  template <class Arc, std::size_t... Terms>
  [[gnu::always_inline]] void slide(const Model& model, Arc& arc,
                                    std::index_sequence<Terms...> /*terms*/) {
    (add_term<Terms>(model, arc), ...);
    shift[Order] = numeric::reciprocal<Scalar>(Order + 1) * motion(Order);
    shift[Order + 1] = numeric::reciprocal<Scalar>(Order + 2) * motion(Order + 1);
    if constexpr (moves) {
      extend(Order + 1);
      for (std::size_t n = 0; n < travel.size(); ++n) {
        this->distance[n] = numeric::reciprocal<Scalar>(n + 1) * travel[n];
      }
    }
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
    if constexpr (moves) {
      if constexpr (N > 0) {
        extend(N);
      }
      vibration[N + 1] = next;
      sliding_velocity[N + 1] =
          (integrated * unit) * (free_load_term(model, N) - model.load_friction(friction[N]));
      travel[N + 1] = next + unit * model.path_share(sliding_velocity[N + 1]);
    } else if constexpr (N == 0) {
      vibration[1] = next;
      travel[1] = next + Model::Sliding::change(model.path_share(sliding_velocity[1]), unit);
    } else {
      travel[N + 1] = next;
    }
  }
};

}  // namespace sonoglide::plant
