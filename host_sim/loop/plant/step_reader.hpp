/// What is read off the steps of a solver.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/velocity_quadrature.hpp"
#include "host_sim/loop/plant/step_meter.hpp"
#include "host_sim/loop/plant/undriven_friction.hpp"

namespace sonoglide::loop {

/// What the friction ratio asks of the sliding of a load.
///
/// Observes the steps of one interval (see plant::NoObserver), in which the sliding velocity r is smooth,
/// and integrates |r| and the undriven friction by Gauss-Legendre quadrature between its turns, r = 0, where
/// both have a kink. Turns closer together than the nodes of a step are passed over.
class LoadMotion {
 public:
  /// @param undriven  null: the friction limit, at any speed. Outlives this
  LoadMotion(double velocity_unit_m_per_s, const UndrivenFriction* undriven)
      : velocity_unit_m_per_s_(velocity_unit_m_per_s), undriven_friction_(undriven) {}

  template <class Step>
  void operator()(const Step& step) {
    const auto velocity_at = [&](double offset) { return step.at(offset).sliding_velocity; };
    double offset = 0.0;
    double velocity = velocity_at(offset);
    double turned = 0.0;
    see(velocity);
    const auto go_to = [&](double next) {
      const double there = velocity_at(next);
      see(there);
      if (velocity * there < 0.0) {
        const double turn = turn_between(velocity_at, offset, next);
        integrate(velocity_at, turned, turn);
        turned = turn;
      }
      offset = next;
      velocity = there;
    };
    for (const double node : rule.node) {
      go_to(step.length() * node);
    }
    go_to(step.length());
    integrate(velocity_at, turned, step.length());
  }

  double distance() const { return distance_; }  ///< integral of |r| over tau
  double undriven() const { return undriven_; }  ///< of F0/Fc
  /// 1 or -1 if it slid in one direction all the time, 0 if it turned or stood.
  double direction() const { return slowest_ > 0.0 ? 1.0 : fastest_ < 0.0 ? -1.0 : 0.0; }

 private:
  static constexpr auto rule = numeric::gauss_legendre<8>();

  template <class Velocity>
  void integrate(const Velocity& velocity_at, double begin, double end) {
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double weight = (end - begin) * rule.weight[i];
      const double velocity = velocity_at(begin + (end - begin) * rule.node[i]);
      distance_ += weight * std::abs(velocity);
      undriven_ += weight * (undriven_friction_ == nullptr
                                 ? 1.0
                                 : undriven_friction_->part_at(velocity * velocity_unit_m_per_s_));
    }
  }

  /// By bisection. The distance is flat over the place of the turn: half of the digits are enough.
  template <class Velocity>
  static double turn_between(const Velocity& velocity_at, double before, double after) {
    const bool forwards = velocity_at(before) > 0.0;
    for (int halving = 0; halving < 26; ++halving) {
      const double middle = 0.5 * (before + after);
      ((velocity_at(middle) > 0.0) == forwards ? before : after) = middle;
    }
    return after;
  }

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

/// How a contact that vibrates normally is loaded.
///
/// Observes the steps of one interval (see plant::NoObserver), each of which ends where the contact
/// opens or closes, and integrates N/N0 = (1 + nu y)_+ by Gauss-Legendre quadrature in each.
///
/// Error: a few roundings for steps up to 3 rad, in which the displacement is smooth.
class ContactLoad {
 public:
  /// @param normal_stiffness  nu, see friction::NormalCoulomb
  explicit ContactLoad(double normal_stiffness) : normal_stiffness_(normal_stiffness) {}

  template <class Step>
  void operator()(const Step& step) {
    static constexpr auto rule = numeric::gauss_legendre<16>();
    const double length = step.length();
    const auto pressure = [&](double offset) {
      return 1.0 + normal_stiffness_ * step.at(offset).displacement;
    };
    if (!(pressure(0.5 * length) > 0.0)) {
      open_ += length;
      return;
    }
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      load_ += length * rule.weight[i] * pressure(length * rule.node[i]);
    }
  }

  double load() const { return load_; }  ///< integral of N/N0 over tau
  double open() const { return open_; }  ///< tau in which the contact is open

 private:
  double normal_stiffness_;
  double load_ = 0.0;
  double open_ = 0.0;
};

/// Reads off the steps, as they are taken, what is asked for; made by default, nothing. One type
/// serves all, so that a solver is compiled once.
class StepReader {
 public:
  StepReader() = default;

  /// States, of which those of a load fill both its parts.
  /// @param offsets_s  since the beginning, rising; outlives the reader, and so does `seen`
  void read_states(const std::vector<double>& offsets_s, double angular_frequency_rad_per_s,
                   std::vector<plant::LoadedState<double>>& seen) {
    next_ = offsets_s.data();
    end_ = next_ + offsets_s.size();
    angular_frequency_rad_per_s_ = angular_frequency_rad_per_s;
    seen_ = &seen;
    reads_ = true;
  }
  /// @param demodulator  outlives the reader
  void demodulate(plant::Demodulator<double>& demodulator) {
    demodulator_ = &demodulator;
    reads_ = true;
  }
  /// @param demodulator  outlives the reader
  void demodulate_moment(plant::MomentDemodulator<double>& demodulator) {
    phase_moment_ = &demodulator;
    reads_ = true;
  }
  /// @param load  outlives the reader
  void weigh(ContactLoad& load) {
    load_ = &load;
    reads_ = true;
  }

  /// @param motion  outlives the reader
  void follow(LoadMotion& motion) {
    motion_ = &motion;
    reads_ = true;
  }

  /// @param begin_s  of the stretch, since the run began
  /// @param meter    outlives the reader
  void count(double begin_s, double angular_frequency_rad_per_s, StepMeter& meter) {
    begin_s_ = begin_s;
    angular_frequency_rad_per_s_ = angular_frequency_rad_per_s;
    meter_ = &meter;
  }
  /// @param moment  to which the integral of t v, t since the beginning, is added
  void take_moment(double& moment) {
    moment_ = &moment;
    reads_ = true;
  }

  template <class Step>
  void operator()(const Step& step) {
    if (meter_ != nullptr) {
      meter_->take(begin_s_ + (step.begin() + step.length()) / angular_frequency_rad_per_s_);
    }
    if (reads_) {
      read(step);
    }
  }

 private:
  template <class Step>
  static constexpr bool has_load =
      std::is_same_v<decltype(std::declval<Step>().at(0.0)), plant::LoadedState<double>>;

  static plant::LoadedState<double> with_load(const plant::State<double>& state) {
    return {state, 0.0, 0.0};
  }
  static plant::LoadedState<double> with_load(const plant::LoadedState<double>& state) {
    return state;
  }

  template <class Step>
  void read(const Step& step) {
    if (demodulator_ != nullptr) {
      (*demodulator_)(step);
    }
    if (phase_moment_ != nullptr) {
      (*phase_moment_)(step);
    }
    if (load_ != nullptr) {
      (*load_)(step);
    }
    if constexpr (has_load<Step>) {
      (*motion_)(step);
    }
    if (moment_ != nullptr) {
      const double travel = step.at(step.length()).displacement - step.at(0.0).displacement;
      *moment_ += step.begin() * travel + plant::velocity_moment(step);
    }
    const double end = step.begin() + step.length();
    for (; next_ != end_; ++next_) {
      const double offset = *next_ * angular_frequency_rad_per_s_;
      if (offset > end) {
        return;
      }
      seen_->push_back(with_load(step.at(std::max(0.0, offset - step.begin()))));
    }
  }

  bool reads_ = false;
  StepMeter* meter_ = nullptr;
  double begin_s_ = 0.0;
  plant::Demodulator<double>* demodulator_ = nullptr;
  plant::MomentDemodulator<double>* phase_moment_ = nullptr;
  ContactLoad* load_ = nullptr;
  LoadMotion* motion_ = nullptr;
  double* moment_ = nullptr;
  const double* next_ = nullptr;
  const double* end_ = nullptr;
  double angular_frequency_rad_per_s_ = 0.0;
  std::vector<plant::LoadedState<double>>* seen_ = nullptr;
};

}  // namespace sonoglide::loop
