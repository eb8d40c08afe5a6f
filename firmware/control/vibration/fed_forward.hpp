/// A vibration of which nothing tells.
#pragma once

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/measurement.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/control/interface/signals.hpp"
#include "firmware/control/vibration/bias_feedback.hpp"
#include "firmware/control/vibration/vibration_part.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// A drive of constant frequency whose amplitude is fed forward.
template <class ScalarT>
class FedForward : public VibrationPart<ScalarT> {
 public:
  static constexpr PartName part_name{"vibration/fed_forward", "FedForward"};
  using Scalar = ScalarT;
  using Measurement = control::Measurement<Scalar>;
  using Command = DriveCommand<Scalar>;
  using Requested = signal::RequestedAmplitude;

  struct Parameters {};

  explicit FedForward(const Parameters&) {}

  /// @param requested  amplitude
  /// @param shaper     that it goes through
  /// @param ceiling    of the amplitude
  template <class Shaper>
  static Request<Scalar> drive(Scalar requested, Shaper& shaper, Scalar ceiling) {
    const Scalar shaped = numeric::observe<signal::ShapedAmplitude>(shaper.shape(requested));
    if (numeric::likely(numeric::is_below(shaped, ceiling))) {
      return {shaped, Limit::none};
    }
    if (ceiling <= shaped) {
      return {ceiling, requested < ceiling ? Limit::actuator : Limit::none};
    }
    return {numeric::clamp(shaped, Scalar{}, ceiling),
            shaped < Scalar{} ? Limit::actuator : Limit::none};
  }
};

/// The same with a bias that takes the friction of the target from the mass.
template <class ScalarT>
class BalancedFedForward : public FedForward<ScalarT> {
 public:
  static constexpr PartName part_name{"vibration/fed_forward", "BalancedFedForward"};
  using Scalar = ScalarT;
  using Command = BiasedCommand<Scalar>;
  using Parameters = typename FrictionBalance<Scalar>::Parameters;

  explicit BalancedFedForward(const Parameters& parameters)
      : FedForward<Scalar>({}), balance_(parameters) {}

  /// See VibrationPart::balance.
  template <class Friction>
  void balance(const DriveCommand<Scalar>& command, const Friction& friction) {
    balance_.expect(command, friction);
  }

  void after(Command& command) const { set_bias(balance_.bias(), command); }

 private:
  FrictionBalance<Scalar> balance_;
};

}  // namespace sonoglide::control
