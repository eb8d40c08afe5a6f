/// One step of the Taylor solver: the motion inside it, and its integrals.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/lane_group.hpp"
#include "firmware/numeric/lane_polynomial.hpp"
#include "firmware/numeric/lanes.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// Friction of a sliding contact: exact in the displacement, which the series gives.
template <class Model, class Series>
class SlidingFriction {
 public:
  using Scalar = typename Series::Scalar;
  using Law = typename Model::FrictionLaw;
  using Arc = typename Law::Arc;

  /// tolerated: the last terms of phi for which its own series gives its integral.
  SlidingFriction(const Series& series, const Arc& arc, Scalar direction, Scalar tolerated)
      : series_(series), arc_(arc), direction_(direction), tolerated_(tolerated) {}

  Scalar at(Scalar x) const { return arc_.friction_after(travelled(x)); }
  Scalar work(Scalar x) const { return arc_.work(travelled(x)); }
  auto memory(Scalar x) const { return arc_.memory_after(travelled(x)); }

  /// Of phi and of x phi over x, from 0 to the extent.
  Scalar integral(Scalar extent) const {
    if constexpr (Law::varies) {
      if (is_beyond_series(extent)) {
        return quadrature<0>(extent);
      }
    }
    return numeric::integrate(series_.friction, extent);
  }
  Scalar moment(Scalar extent) const {
    if constexpr (Law::varies) {
      if (is_beyond_series(extent)) {
        return quadrature<1>(extent);
      }
    }
    return numeric::first_moment(series_.friction, extent);
  }

 private:
  static constexpr std::size_t order = Series::order;

  /// An increment that never goes backwards: the difference of two displacements would cancel.
  Scalar travelled(Scalar x) const {
    return numeric::max(Scalar(0), direction_ * series_.travelled(x));
  }

  /// Whether the last terms of phi, times the length of a long step, exceed what is tolerated.
  bool is_beyond_series(Scalar x) const {
    const Scalar last = numeric::max(x * numeric::abs(series_.friction[order]),
                                     numeric::abs(series_.friction[order - 1]));
    return numeric::max(Scalar(1), series_.unit * x) * numeric::power<order - 1>(x) * last >
           tolerated_;
  }

  /// Integral of x^Power phi by Gauss-Legendre quadrature from the displacement, which stays
  /// accurate after the series of phi has ceased to converge. Out of line: most steps use the
  /// series. Pure: two accounts of one step need it once.
  template <int Power>
  [[gnu::noinline, gnu::pure]] Scalar quadrature(Scalar extent) const {
    constexpr std::size_t width = numeric::lane_count<Scalar>;
    constexpr auto& rule = numeric::gauss_rule<Scalar, (order / 2 + width - 1) / width * width>;
    const auto x = extent * numeric::load_group<rule.vectors>(rule.node.data());
    auto travel = series_.distances();
    travel[0] = series_.travel[0];
    travel[1] = numeric::half(series_.travel[1]);
    auto weighted = numeric::load_group<rule.vectors>(rule.weight.data()) *
                    arc_.friction_along(direction_ * (x * numeric::value_at(travel, x)));
    if constexpr (Power == 1) {
      weighted *= x;
    }
    return extent * numeric::sum_of_lanes(weighted);
  }

  const Series& series_;
  const Arc& arc_;
  Scalar direction_;
  Scalar tolerated_;
};

/// Friction of a contact that sticks, given by the series; it does no work.
template <class Series>
class HoldingFriction {
 public:
  using Scalar = typename Series::Scalar;

  explicit HoldingFriction(const Series& series) : series_(series) {}

  Scalar at(Scalar x) const {
    return numeric::clamp(numeric::evaluate(series_.friction, x), Scalar(-1), Scalar(1));
  }
  Scalar work(Scalar /*x*/) const { return Scalar(0); }
  Scalar integral(Scalar extent) const { return numeric::integrate(series_.friction, extent); }
  Scalar moment(Scalar extent) const { return numeric::first_moment(series_.friction, extent); }

 private:
  const Series& series_;
};

/// A view of a series over one step; integrals are computed when asked for.
template <class Model, class Series, class Friction>
class TaylorStep {
 public:
  using Scalar = typename Series::Scalar;
  using Motion = typename Model::Motion;

  /// extent: length of the step in units of the series.
  TaylorStep(const Model& model, const Series& series, const Friction& friction, Scalar begin,
             Scalar extent)
      : model_(model), series_(series), friction_(friction), begin_(begin), extent_(extent) {}

  Scalar begin() const { return begin_; }
  Scalar length() const { return series_.unit * extent_; }
  Motion at(Scalar offset) const { return state(offset / series_.unit); }
  Motion end() const { return state(extent_); }

  Scalar friction_integral() const { return series_.unit * friction_.integral(extent_); }
  Scalar friction_work() const { return friction_.work(extent_); }
  Scalar sliding_work() const {
    if constexpr (Model::Sliding::moves) {
      return quadrature(
          [this](Scalar x) { return friction_.at(x) * series_.sliding_velocity_at(x); });
    }
    Scalar sum = series_.sliding_velocity[0] * friction_.integral(extent_);
    if constexpr (Model::Sliding::varies) {
      sum += series_.sliding_velocity[1] * friction_.moment(extent_);
    }
    return series_.unit * sum;
  }

  /// By Gauss-Legendre quadrature, exact for the product of two series up to their order less 1.
  MotionIntegrals<Scalar> motion_integrals() const {
    static constexpr auto rule = numeric::gauss_legendre<node_count>();
    MotionIntegrals<Scalar> sum;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const Scalar x = extent_ * numeric::from_real<Scalar>(rule.node[i]);
      const Scalar weight = length() * numeric::from_real<Scalar>(rule.weight[i]);
      sum.add(weight, series_.drive.at(x), series_.displacement_at(x), series_.velocity_at(x));
    }
    sum.damping_work = model_.damping_force(sum.velocity_square);
    return sum;
  }

  /// Of a load, by the same quadrature.
  LoadIntegrals<Scalar> load_integrals() const {
    const auto linear = [](const std::array<Scalar, 2>& line, Scalar x) {
      return line[0] + x * line[1];
    };
    LoadIntegrals<Scalar> integrals;
    integrals.force_work = quadrature(
        [&](Scalar x) { return linear(series_.load_force, x) * series_.sliding_velocity_at(x); });
    integrals.pull_work = quadrature([&](Scalar x) {
      return -model_.load_stiffness * numeric::evaluate(series_.extension, x) *
             linear(series_.pull_velocity, x);
    });
    integrals.velocity_square = quadrature(
        [&](Scalar x) { return series_.sliding_velocity_at(x) * series_.sliding_velocity_at(x); });
    return integrals;
  }

 private:
  static constexpr int node_count = static_cast<int>(Series::order) / 2;

  template <class Integrand>
  Scalar quadrature(const Integrand& at) const {
    static constexpr auto rule = numeric::gauss_legendre<node_count>();
    Scalar sum = Scalar(0);
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      sum += numeric::from_real<Scalar>(rule.weight[i]) *
             at(extent_ * numeric::from_real<Scalar>(rule.node[i]));
    }
    return length() * sum;
  }

  Motion state(Scalar x) const {
    const State<Scalar> oscillator = {series_.displacement_at(x), series_.velocity_at(x),
                                      friction_.at(x)};
    if constexpr (Model::Sliding::moves) {
      return {oscillator, series_.sliding_velocity_at(x), numeric::evaluate(series_.extension, x)};
    } else {
      return oscillator;
    }
  }

  const Model& model_;
  const Series& series_;
  const Friction& friction_;
  Scalar begin_;
  Scalar extent_;
};

}  // namespace sonoglide::plant
