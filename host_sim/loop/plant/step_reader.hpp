/// What is read off the steps of a solver.
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "firmware/plant/state.hpp"
#include "firmware/plant/velocity_quadrature.hpp"
#include "host_sim/loop/plant/contact_load.hpp"
#include "host_sim/loop/plant/load_motion.hpp"
#include "host_sim/loop/plant/step_meter.hpp"

namespace sonoglide::loop {

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
