/// A vibration whose slow natural mode a bias force damps.
#pragma once

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/measurement.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/vibration/bias_feedback.hpp"
#include "firmware/control/vibration/damped_vibration.hpp"
#include "firmware/control/vibration/pair.hpp"
#include "firmware/control/vibration/past_drive.hpp"
#include "firmware/control/vibration/sensorless_vibration.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// DampedVibration with a bias that answers the mean velocity that the vibration sensor shows.
template <class ScalarT, int MaxDelay>
class BiasedDampedVibration : public DampedVibration<ScalarT, MaxDelay> {
  using Damped = DampedVibration<ScalarT, MaxDelay>;

 public:
  static constexpr PartName part_name{"vibration/biased_damping", "BiasedDampedVibration"};
  using Scalar = ScalarT;
  using Measurement = MotionMeasurement<Scalar>;
  using Command = BiasedCommand<Scalar>;

  struct Parameters {
    typename Damped::Parameters vibration;
    typename BiasFeedback<Scalar>::Parameters bias;
    typename FrictionBalance<Scalar>::Parameters balance;

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("vibration", self.vibration);
      visit("bias", self.bias);
      visit("balance", self.balance);
    }
  };

  /// @param parameters  outlive this, see DampedVibration
  explicit BiasedDampedVibration(const Parameters& parameters)
      : Damped(parameters.vibration), feedback_(parameters.bias), balance_(parameters.balance) {}

  /// See Controller::settle_at.
  void settle_at(const Parameters& parameters) { Damped::settle_at(parameters.vibration); }

  /// Takes a sample of usable numbers.
  Fault observe(const Measurement& measurement) {
    mean_velocity_ = measurement.mean_velocity;
    return Damped::observe(measurement);
  }

  /// See VibrationPart::balance.
  template <class Friction>
  void balance(const DriveCommand<Scalar>& command, const Friction& friction) {
    balance_.expect(command, friction);
  }

  void after(Command& command) {
    Damped::after(command);
    feedback_.answer(mean_velocity_, command, balance_.bias());
  }

 private:
  BiasFeedback<Scalar> feedback_;
  FrictionBalance<Scalar> balance_;
  Scalar mean_velocity_{};
};

/// SensorlessVibration with a bias that answers the mean velocity of the mode as it is observed: that in
/// the last period under way, predicted with the biases under way.
template <class ScalarT, int MaxDelay, class ReadingT>
class BiasedSensorlessVibration : public SensorlessVibration<ScalarT, MaxDelay, ReadingT> {
  using Sensorless = SensorlessVibration<ScalarT, MaxDelay, ReadingT>;
  using Sensorless::observer_;

 public:
  static constexpr PartName part_name{"vibration/biased_damping", "BiasedSensorlessVibration"};
  using Scalar = ScalarT;
  using Command = BiasedCommand<Scalar>;

  struct Parameters {
    typename Sensorless::Parameters vibration;
    typename BiasFeedback<Scalar>::Parameters bias;
    typename FrictionBalance<Scalar>::Parameters balance;
    Scalar mean_of_first;   ///< mean velocity of a mode whose first coordinate is 1, half of it
    Scalar mean_of_second;  ///< likewise
    /// What a bias of 1 takes from the second coordinate of w, at its begin.
    numeric::Split<Scalar> displacement;

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("vibration", self.vibration);
      visit("bias", self.bias);
      visit("balance", self.balance);
      visit("mean_of_first", self.mean_of_first);
      visit("mean_of_second", self.mean_of_second);
      visit("displacement", self.displacement);
    }
  };

  /// @param parameters  outlive this, see SensorlessVibration
  explicit BiasedSensorlessVibration(const Parameters& parameters)
      : Sensorless(parameters.vibration),
        feedback_(parameters.bias),
        balance_(parameters.balance),
        mean_{parameters.mean_of_first, parameters.mean_of_second},
        displacement_(numeric::floating(parameters.displacement)),
        past_bias_(parameters.vibration.delay) {}

  /// See Controller::settle_at.
  void settle_at(const Parameters& parameters) { Sensorless::settle_at(parameters.vibration); }

  void restart(bool rested) {
    Sensorless::restart(rested);
    if (rested) {
      past_bias_.clear();
    }
  }

  void before() {
    Sensorless::before();
    observer_.displace(displaced(past_bias_.sampled(), past_bias_.sampled(1)));
  }

  /// See VibrationPart::balance.
  template <class Friction>
  void balance(const DriveCommand<Scalar>& command, const Friction& friction) {
    balance_.expect(command, friction);
  }

  void after(Command& command) {
    Sensorless::after(command);
    const Pair<Scalar> mode = this->predicted_mode() + predicted_displacement();
    // The balance leaves the mode where it is.
    past_bias_.append(feedback_.answer(mean_.first * mode.first + mean_.second * mode.second,
                                       command, balance_.bias()));
  }

 private:
  Scalar displaced(Scalar now, Scalar before) const {
    return numeric::limited_product(numeric::half(before) - numeric::half(now), displacement_);
  }

  /// What the biases under way add to the mode in the last period under way.
  Pair<Scalar> predicted_displacement() const {
    Pair<Scalar> added{};
    Scalar before = past_bias_.sampled();
    for (std::size_t i = 0; i < past_bias_.delay(); ++i) {
      added = observer_.next(added, Scalar{});
      added.second = added.second + displaced(past_bias_.under_way(i), before);
      before = past_bias_.under_way(i);
    }
    return added;
  }

  BiasFeedback<Scalar> feedback_;
  FrictionBalance<Scalar> balance_;
  Pair<Scalar> mean_;
  numeric::Floating<Scalar> displacement_;
  PastDrive<Scalar, MaxDelay, 1> past_bias_;
};

}  // namespace sonoglide::control
