/// Names of the controller's internal signals, for the saturation ledger of a simulation.
#pragma once

namespace sonoglide::control::signal {

struct ForeseenVelocity {
  static constexpr const char* name = "foreseen_velocity";  ///< base: full drive's peak velocity
};
struct MeasuredRatio {
  static constexpr const char* name = "measured_ratio";  ///< base 2
};
struct RatioError {
  static constexpr const char* name = "ratio_error";  ///< base 2
};
struct RatioIntegral {
  static constexpr const char* name = "ratio_integral";  ///< base 2
};
struct CommandedRatio {
  static constexpr const char* name = "commanded_ratio";  ///< base 2
};
struct RequestedAmplitude {
  static constexpr const char* name = "requested_amplitude";  ///< base: the actuator's limit
};
struct RequestedVelocity {
  static constexpr const char* name = "requested_velocity";  ///< base: the vibration sensor's range
};
struct VibrationVelocity {
  static constexpr const char* name = "vibration_velocity";  ///< likewise
};
struct ShapedAmplitude {
  static constexpr const char* name = "shaped_amplitude";  ///< base: the actuator's limit
};

}  // namespace sonoglide::control::signal
