/// Which samples can be used, and how many that cannot are bridged.
#pragma once

#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/measurement.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

template <Numbers Known, class Scalar>
Fault inspect_vibration(const Measurement<Scalar>& /*no vibration*/) {
  return Fault::none;
}

template <Numbers Known, class Scalar>
Fault inspect_vibration(const VibrationMeasurement<Scalar>& sample) {
  if (sample.vibration_quality == Quality::missing) {
    return Fault::vibration_missing;
  }
  if (sample.vibration_quality == Quality::saturated) {
    return Fault::vibration_saturated;
  }
  const bool finite = Known == Numbers::finite || (numeric::is_finite(sample.in_phase) &&
                                                   numeric::is_finite(sample.quadrature));
  return finite ? Fault::none : Fault::measurement_not_finite;
}

template <Numbers Known, class Scalar>
Fault inspect_vibration(const MotionMeasurement<Scalar>& sample) {
  const auto& vibration = static_cast<const VibrationMeasurement<Scalar>&>(sample);
  const Fault unusable = inspect_vibration<Known>(vibration);
  const bool finite = Known == Numbers::finite || numeric::is_finite(sample.mean_velocity);
  return unusable == Fault::none && !finite ? Fault::measurement_not_finite : unusable;
}

/// @tparam Force  ForceSensor | NoForceSensor, whose reading is then not looked at
/// @tparam Known  what is known of the numbers beforehand
template <class Force, Numbers Known, class Sample>
Fault inspect(const Sample& sample) {
  if (sample.quality == Quality::missing) {
    return Fault::measurement_missing;
  }
  if (const Fault unusable = inspect_vibration<Known>(sample); unusable != Fault::none) {
    return unusable;
  }
  if (Force::present && sample.quality == Quality::saturated) {
    return Fault::measurement_saturated;
  }
  const bool finite =
      Known == Numbers::finite || ((!Force::present || numeric::is_finite(sample.friction_force)) &&
                                   numeric::is_finite(sample.sliding_velocity));
  return finite ? Fault::none : Fault::measurement_not_finite;
}

/// Every sample must be usable.
struct StrictSamples {
  struct Parameters {};

  explicit StrictSamples(const Parameters&) {}
  static constexpr void restart() {}
  /// @return whether the controller may go on
  static constexpr bool accept(bool usable) { return usable; }
};

/// N of the last M samples may be unusable. Until the next usable sample the last request stays in
/// force. With N = 0 it is as strict as StrictSamples.
class TolerantSamples {
 public:
  struct Parameters {
    std::uint8_t tolerated = 0;  ///< N, < window
    std::uint8_t window = 1;     ///< M, 1 … 32

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("tolerated", self.tolerated);
      visit("window", self.window);
    }
  };

  explicit TolerantSamples(const Parameters& parameters) : parameters_(parameters) {}

  void restart() { unusable_ = 0; }

  /// One call for each sample.
  /// @return whether the controller may go on
  bool accept(bool usable) {
    if (usable && unusable_ == 0) {
      return true;  // as nearly always: nothing moves in the window
    }
    unusable_ = (unusable_ << 1 | (usable ? 0U : 1U)) & (UINT32_MAX >> (32 - parameters_.window));
    return usable || count(unusable_) <= parameters_.tolerated;
  }

 private:
  static std::uint32_t count(std::uint32_t bits) {
    std::uint32_t number = 0;
    for (; bits != 0; bits &= bits - 1) {
      ++number;
    }
    return number;
  }

  Parameters parameters_;
  std::uint32_t unusable_ = 0;  ///< a bit a sample, the latest lowest
};

}  // namespace sonoglide::control
