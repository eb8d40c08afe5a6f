/// What the friction ratio asks of the sliding of a load.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "firmware/numeric/gauss_legendre.hpp"
#include "host_sim/loop/plant/undriven_friction.hpp"

namespace sonoglide::loop {

/// Observes the steps of one interval (see plant::NoObserver), in which the sliding velocity is smooth,
/// and integrates its modulus and the undriven friction by Gauss-Legendre quadrature in each.
class LoadMotion {
 public:
  /// @param undriven  null: the friction limit, at any speed. Outlives this
  LoadMotion(double velocity_unit_m_per_s, const UndrivenFriction* undriven)
      : velocity_unit_m_per_s_(velocity_unit_m_per_s), undriven_friction_(undriven) {}

  template <class Step>
  void operator()(const Step& step) {
    static constexpr auto rule = numeric::gauss_legendre<8>();
    const double length = step.length();
    see(step.at(0.0).sliding_velocity);
    see(step.at(length).sliding_velocity);
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double velocity = step.at(length * rule.node[i]).sliding_velocity;
      see(velocity);
      distance_ += length * rule.weight[i] * std::abs(velocity);
      undriven_ += length * rule.weight[i] *
                   (undriven_friction_ == nullptr
                        ? 1.0
                        : undriven_friction_->part_at(velocity * velocity_unit_m_per_s_));
    }
  }

  double distance() const { return distance_; }  ///< integral of |r| over tau
  double undriven() const { return undriven_; }  ///< of F0/Fc
  /// 1 or -1 if it slid in one direction all the time, 0 if it turned or stood.
  double direction() const { return slowest_ > 0.0 ? 1.0 : fastest_ < 0.0 ? -1.0 : 0.0; }

 private:
  void see(double velocity) {
    slowest_ = std::min(slowest_, velocity);
    fastest_ = std::max(fastest_, velocity);
  }

  double velocity_unit_m_per_s_;
  const UndrivenFriction* undriven_friction_;
  double slowest_ = std::numeric_limits<double>::infinity();
  double fastest_ = -std::numeric_limits<double>::infinity();
  double distance_ = 0.0;
  double undriven_ = 0.0;
};

}  // namespace sonoglide::loop
