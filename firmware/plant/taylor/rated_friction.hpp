/// Friction that depends on the speed as well, inside a step of the Taylor method.
#pragma once

#include <cstddef>

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

}  // namespace sonoglide::plant
