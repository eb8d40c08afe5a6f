/// A drive of constant frequency whose amplitude is fed forward: nothing tells of the vibration.
#pragma once

#include "firmware/control/drive_command.hpp"
#include "firmware/control/measurement.hpp"

namespace sonoglide::control {

template <class ScalarT>
class FedForward {
 public:
  using Measurement = control::Measurement<ScalarT>;
  using Command = DriveCommand<ScalarT>;
  static constexpr bool observed = false;
  static constexpr bool felt = false;
  static constexpr Limit at_full_drive = Limit::actuator;

  struct Parameters {};

  explicit FedForward(const Parameters&) {}
};

}  // namespace sonoglide::control
