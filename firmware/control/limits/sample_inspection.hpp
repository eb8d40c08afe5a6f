/// Whether the numbers of a sample can be used.
#pragma once

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

}  // namespace sonoglide::control
