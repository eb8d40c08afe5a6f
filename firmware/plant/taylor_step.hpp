/// One step of the Taylor solver: the motion inside it, and its integrals.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/friction/gauss_legendre.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/polynomial.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// Friction of a sliding contact: exact in the displacement, which the series gives.
template <class Series, class Arc>
class SlidingFriction {
 public:
  using Scalar = typename Series::Scalar;

  SlidingFriction(const Series& series, const Arc& arc, Scalar direction)
      : series_(series), arc_(arc), direction_(direction) {}

  Scalar at(Scalar x) const { return arc_.friction_after(travelled(x)); }
  Scalar work(Scalar x) const { return arc_.work(travelled(x)); }

 private:
  /// An increment, and never backwards: a difference of two displacements would cancel.
  Scalar travelled(Scalar x) const {
    return numeric::max(Scalar(0), direction_ * series_.travelled(x));
  }

  const Series& series_;
  const Arc& arc_;
  Scalar direction_;
};

/// Friction of a contact that holds: as the series has it, and no work.
template <class Series>
class HoldingFriction {
 public:
  using Scalar = typename Series::Scalar;

  explicit HoldingFriction(const Series& series) : series_(series) {}

  Scalar at(Scalar x) const {
    return numeric::clamp(evaluate(series_.friction, x), Scalar(-1), Scalar(1));
  }
  Scalar work(Scalar /*x*/) const { return Scalar(0); }

 private:
  const Series& series_;
};

/// A view of a series over one step; integrals are computed when asked for.
template <class Model, class Series, class Friction>
class TaylorStep {
 public:
  using Scalar = typename Series::Scalar;

  /// extent: length of the step in units of the series.
  TaylorStep(const Model& model, const Series& series, const Friction& friction, Scalar begin,
             Scalar extent)
      : model_(model), series_(series), friction_(friction), begin_(begin), extent_(extent) {}

  Scalar begin() const { return begin_; }
  Scalar length() const { return series_.unit * extent_; }
  State<Scalar> at(Scalar offset) const { return state(offset / series_.unit); }
  State<Scalar> end() const { return state(extent_); }

  Scalar friction_integral() const { return series_.unit * integrate(series_.friction, extent_); }
  Scalar friction_work() const { return friction_.work(extent_); }
  Scalar sliding_work() const {
    const Scalar steady = series_.sliding_velocity[0] * integrate(series_.friction, extent_);
    const Scalar slope = series_.sliding_velocity[1];
    // Most scenes slide at a constant speed.
    return series_.unit *
           (slope == Scalar(0) ? steady : steady + slope * first_moment(series_.friction, extent_));
  }

  /// By Gauss and Legendre, exact for the product of two series up to their order less 3.
  MotionIntegrals<Scalar> motion_integrals() const {
    static constexpr auto rule = friction::gauss_legendre<node_count>();
    MotionIntegrals<Scalar> sum;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const Scalar x = extent_ * numeric::from_real<Scalar>(rule.node[i]);
      const Scalar weight = length() * numeric::from_real<Scalar>(rule.weight[i]);
      sum.add(weight, series_.drive.at(x), series_.displacement_at(x), series_.velocity_at(x));
    }
    sum.damping_work = model_.damping_force(sum.velocity_square);
    return sum;
  }

 private:
  static constexpr int node_count = static_cast<int>(Series::order) / 2 - 1;

  State<Scalar> state(Scalar x) const {
    return {series_.displacement_at(x), series_.velocity_at(x), friction_.at(x)};
  }

  const Model& model_;
  const Series& series_;
  const Friction& friction_;
  Scalar begin_;
  Scalar extent_;
};

}  // namespace sonoglide::plant
