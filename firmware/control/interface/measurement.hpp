/// What the controller is told once per carrier period.
#pragma once

#include <cstdint>

namespace sonoglide::control {

enum class Quality : std::uint8_t {
  good,
  saturated,  ///< the force converter stood at a rail
  missing,    ///< no fresh sample since the last step
};

/// What is known of the numbers of a sample.
enum class Numbers : std::uint8_t {
  any,
  finite,  ///< as numbers made of codes are
};

/// One sample, per unit.
template <class Scalar>
struct Measurement {
  Scalar friction_force;    ///< mean over the last carrier period; base: the force full scale
  Scalar sliding_velocity;  ///< base: peak vibration velocity at full drive; not -0
  Quality quality = Quality::good;
  bool velocity_at_rail = false;  ///< the speed is at least that of sliding_velocity
};

/// With the vibration: its velocity is Re(z e^jθ), θ the phase of the drive, and z = in_phase + j
/// quadrature the mean over the last carrier period.
template <class Scalar>
struct VibrationMeasurement : Measurement<Scalar> {
  Scalar in_phase;    ///< on the base of the sliding velocity
  Scalar quadrature;  ///< likewise
  Quality vibration_quality = Quality::good;
};

/// With the mean of the vibration's velocity over the last carrier period.
template <class Scalar>
struct MotionMeasurement : VibrationMeasurement<Scalar> {
  Scalar mean_velocity;  ///< on the base of the sliding velocity
};

}  // namespace sonoglide::control
