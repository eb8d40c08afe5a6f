/// Conversion between the codes of a board and the numbers of a controller.
#pragma once

#include <cstdint>
#include <utility>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/measurement.hpp"
#include "firmware/numeric/scalar.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

/// Codes as per-unit numbers, finite and rounded as numeric::from_code. A sample that is not fresh is missing,
/// even if its force is at a rail.
template <class Scalar>
control::Measurement<Scalar> measurement_of(const hal::Sample& sample) {
  control::Quality quality = control::Quality::good;
  if (!sample.fresh) {
    quality = control::Quality::missing;
  } else if (sample.force_at_rail) {
    quality = control::Quality::saturated;
  }
  return {numeric::from_code<Scalar>(sample.friction_force),
          numeric::from_code<Scalar>(sample.sliding_velocity), quality, sample.velocity_at_rail};
}

/// The same with the vibration.
template <class Scalar>
control::VibrationMeasurement<Scalar> measurement_of(const hal::VibrationSample& sample) {
  control::Quality quality = control::Quality::good;
  if (!sample.vibration_fresh) {
    quality = control::Quality::missing;
  } else if (sample.vibration_at_rail) {
    quality = control::Quality::saturated;
  }
  return {measurement_of<Scalar>(static_cast<const hal::Sample&>(sample)),
          numeric::from_code<Scalar>(sample.in_phase),
          numeric::from_code<Scalar>(sample.quadrature), quality};
}

/// The same with the mean velocity of the vibration.
template <class Scalar>
control::MotionMeasurement<Scalar> measurement_of(const hal::MotionSample& sample) {
  return {measurement_of<Scalar>(static_cast<const hal::VibrationSample&>(sample)),
          numeric::from_code<Scalar>(sample.mean_velocity)};
}

/// Per-unit numbers as codes, rounded and limited as numeric::to_code.
template <class Scalar>
hal::Drive drive_of(const control::DriveCommand<Scalar>& command) {
  return {numeric::to_code(command.amplitude),      numeric::to_code(command.commanded_ratio),
          static_cast<std::uint8_t>(command.state), static_cast<std::uint8_t>(command.limit),
          static_cast<std::uint8_t>(command.fault), static_cast<std::uint8_t>(command.settling)};
}

template <class Scalar>
hal::ResonantDrive drive_of(const control::ResonantCommand<Scalar>& command) {
  return {drive_of(static_cast<const control::DriveCommand<Scalar>&>(command)), command.frequency};
}

template <class Scalar>
hal::BiasedDrive drive_of(const control::BiasedCommand<Scalar>& command) {
  return {drive_of(static_cast<const control::DriveCommand<Scalar>&>(command)),
          numeric::to_code(command.bias)};
}

namespace detail {

template <class Measurement>
struct SampleOf;
template <class Scalar>
struct SampleOf<control::Measurement<Scalar>> {
  using Type = hal::Sample;
};
template <class Scalar>
struct SampleOf<control::VibrationMeasurement<Scalar>> {
  using Type = hal::VibrationSample;
};
template <class Scalar>
struct SampleOf<control::MotionMeasurement<Scalar>> {
  using Type = hal::MotionSample;
};

}  // namespace detail

/// What a board hands to a controller, and what it gets.
template <class ControllerT>
using SampleOf = typename detail::SampleOf<typename ControllerT::Measurement>::Type;
template <class ControllerT>
using DriveOf = decltype(drive_of(std::declval<const typename ControllerT::Command&>()));

}  // namespace sonoglide::app
