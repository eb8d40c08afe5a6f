/// Friction of a contact that vibrates across the sliding, inside a step of the Taylor method.
#pragma once

#include <cstddef>

#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

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

}  // namespace sonoglide::plant
