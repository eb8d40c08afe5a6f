/// Friction of a sliding contact inside a step of the Taylor method, and corners of its law.
#pragma once

#include <cstddef>
#include <limits>

#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

/// The law of a sliding contact as the solver writes it in powers of time: exact in the
/// displacement, or a series of its own.
template <class Law, std::size_t Order, bool RateIndependent = Law::rate_independent>
struct SlidingLaw {
  using Type = typename Law::Arc;
};
template <class Law, std::size_t Order>
struct SlidingLaw<Law, Order, false> {
  using Type = typename Law::template Series<Order>;
};

/// Friction of a sliding contact, given by the series.
template <class Series, class LawSeries>
class RatedFriction {
 public:
  using Scalar = typename Series::Scalar;

  RatedFriction(const Series& series, const LawSeries& law, Scalar /*direction*/,
                Scalar /*tolerated*/)
      : series_(series), law_(law) {}

  Scalar at(Scalar x) const { return numeric::evaluate(series_.friction, x); }
  /// Work by Gauss-Legendre quadrature, exact for the product of two series up to their order less
  /// 1.
  Scalar work(Scalar x) const {
    static constexpr auto rule = numeric::gauss_legendre<static_cast<int>(Series::order) / 2>();
    Scalar sum = Scalar(0);
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const Scalar part = x * numeric::from_real<Scalar>(rule.node[i]);
      sum += numeric::from_real<Scalar>(rule.weight[i]) * at(part) * series_.travel_rate(part);
    }
    return x * sum;
  }
  Scalar integral(Scalar extent) const { return numeric::integrate(series_.friction, extent); }
  Scalar moment(Scalar extent) const { return numeric::first_moment(series_.friction, extent); }
  auto memory(Scalar x) const { return law_.memory(x); }

 private:
  const Series& series_;
  const LawSeries& law_;
};

// Friction of a contact that vibrates across the sliding, inside a step of the Taylor method.

/// Friction along the sliding comes from the slip itself, its integrals from the series of the law.
template <class Series, class LawSeries>
class AcrossFriction {
 public:
  using Scalar = typename Series::Scalar;

  AcrossFriction(const Series& series, const LawSeries& law, Scalar /*direction*/,
                 Scalar /*tolerated*/)
      : series_(series), law_(law) {
    for (std::size_t n = 0; n < friction_.size(); ++n) {
      friction_[n] = law.friction_along(n);
    }
  }

  Scalar at(Scalar x) const { return law_.friction(sliding_velocity(x), series_.velocity_at(x)); }
  /// Work of both parts of the friction, by Gauss-Legendre quadrature.
  Scalar work(Scalar x) const {
    static constexpr auto rule = numeric::gauss_legendre<static_cast<int>(Series::order) / 2>();
    Scalar sum = Scalar(0);
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const Scalar part = x * numeric::from_real<Scalar>(rule.node[i]);
      sum += numeric::from_real<Scalar>(rule.weight[i]) *
             law_.power(sliding_velocity(part), series_.velocity_at(part));
    }
    return series_.unit * (x * sum);
  }
  Scalar integral(Scalar extent) const { return numeric::integrate(friction_, extent); }
  Scalar moment(Scalar extent) const { return numeric::first_moment(friction_, extent); }

 private:
  Scalar sliding_velocity(Scalar x) const {
    return series_.sliding_velocity[0] + x * series_.sliding_velocity[1];
  }

  const Series& series_;
  const LawSeries& law_;
  typename Series::Coefficients friction_{};
};

// Where inside a step the travel reaches a corner of the friction law.

/// The x in (0, end] at which a travel that does not turn back has gone `distance` > 0, within some
/// roundings of the distance. `end` if the travel is shorter.
///
/// @param series     of the travel over x: offers travelled(x) and its derivative travel_rate(x).
/// @param direction  of the travel, +1 or -1.
/// @param distance   from x = 0 to the corner, along the direction.
/// @param end        of the step.
/// Newton's method between bounds: a step that would leave them is replaced by halving.
template <class Series, class Scalar>
Scalar corner(const Series& series, Scalar direction, Scalar distance, Scalar end) {
  const Scalar whole = direction * series.travelled(end);
  if (!(whole > distance)) {
    return end;
  }
  const Scalar rounding = Scalar(2) * std::numeric_limits<Scalar>::epsilon();
  Scalar low = Scalar(0);
  Scalar high = end;
  Scalar x = end * (distance / whole);
  while (low < x && x < high) {
    const Scalar beyond = direction * series.travelled(x) - distance;
    if (numeric::abs(beyond) <= rounding * distance) {
      return x;
    }
    (beyond > Scalar(0) ? high : low) = x;
    const Scalar newton = x - direction * beyond / series.travel_rate(x);
    x = low < newton && newton < high ? newton : low + numeric::half(high - low);
  }
  return high;
}

}  // namespace sonoglide::plant
