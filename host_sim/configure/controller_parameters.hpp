/// A designed controller's parameters in its own scalar: the only place that makes them, for the
/// simulation and for an image alike.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "firmware/control/controller.hpp"
#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/friction/dahl_feedforward.hpp"
#include "firmware/control/friction/learnt_friction.hpp"
#include "firmware/control/friction/periodic_relearning.hpp"
#include "firmware/control/limits/current_limit.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "firmware/control/limits/slew_limit.hpp"
#include "firmware/control/vibration/damped_vibration.hpp"
#include "firmware/control/vibration/resonant_vibration.hpp"
#include "firmware/control/vibration/sensorless_vibration.hpp"
#include "firmware/numeric/accumulator.hpp"
#include "firmware/numeric/scalar.hpp"
#include "host_sim/configure/control_design.hpp"

namespace sonoglide::configure {

/// Names a type without an object of it.
template <class T>
struct Type {
  using type = T;
};

template <class Scalar>
Scalar scaled(double value) {
  return numeric::from_real<Scalar>(value);
}

/// A number that fixed point limits to its range.
template <class Scalar>
Scalar scaled_within(double value) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return value < 1.0 ? scaled<Scalar>(value) : Scalar::largest();
  }
  return scaled<Scalar>(value);
}

/// A positive number of any magnitude.
template <class Scalar>
numeric::Split<Scalar> split(double value) {
  const numeric::Split<double> parts = numeric::split(value);
  return {scaled<Scalar>(parts.mantissa), parts.exponent};
}

/// A target friction ratio as a controller takes it, on base 2.
template <class Scalar>
Scalar half_target(double friction_ratio) {
  return scaled<Scalar>(0.5 * friction_ratio);
}

/// Of a part that has none.
template <class Part>
std::enable_if_t<std::is_empty_v<typename Part::Parameters>, typename Part::Parameters> parameters(
    const ControlDesign& /*design*/, Type<Part> /*part*/) {
  return {};
}

template <class Scalar>
typename control::LearntFriction<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::LearntFriction<Scalar>> /*part*/) {
  return {design.calibration_settle_periods, design.calibration_average_periods,
          scaled<numeric::Accumulator<Scalar>>(design.calibration_weight),
          design.calibration_total_periods, scaled_within<Scalar>(design.calibration_half_steady)};
}

template <class Scalar>
typename control::DahlFeedforward<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::DahlFeedforward<Scalar>> /*part*/) {
  return {split<Scalar>(design.contact_force)};
}

/// Wide open where the design has none.
template <class Scalar>
typename control::SlewLimit<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::SlewLimit<Scalar>> /*part*/) {
  return {design.slew_limited ? scaled<Scalar>(design.slew_per_period)
                              : numeric::from_code<Scalar>(INT32_MAX)};
}

/// Binary digits behind the point of a number just below 1.
template <class Scalar>
constexpr int fraction_digits() {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return Scalar::fraction_bits;
  } else {
    return std::numeric_limits<Scalar>::digits;
  }
}

template <class Scalar, int MaxSpacing>
typename control::NotchShaper<Scalar, MaxSpacing, 3>::Parameters parameters(
    const ControlDesign& design, Type<control::NotchShaper<Scalar, MaxSpacing, 3>> /*part*/) {
  const auto& taps = design.notch()->taps;
  return {{scaled<Scalar>(taps[0]), scaled<Scalar>(taps[1]), scaled<Scalar>(taps[2])},
          design.notch()->spacing};
}

template <class Scalar, int MaxSpacing>
typename control::NotchShaper<Scalar, MaxSpacing, 5>::Parameters parameters(
    const ControlDesign& design, Type<control::NotchShaper<Scalar, MaxSpacing, 5>> /*part*/) {
  const auto taps = rounded_taps(*design.notch(), fraction_digits<Scalar>());
  return {{scaled<Scalar>(taps[0]), scaled<Scalar>(taps[1]), scaled<Scalar>(taps[2]),
           scaled<Scalar>(taps[3]), scaled<Scalar>(taps[4])},
          design.notch()->spacing};
}

template <class Scalar, int MaxDelay>
typename control::IntegralRegulator<Scalar, MaxDelay>::Parameters parameters(
    const ControlDesign& design, Type<control::IntegralRegulator<Scalar, MaxDelay>> /*part*/) {
  return {scaled<Scalar>(design.integral_gain), scaled<Scalar>(design.reference_keep),
          design.hold_periods, design.rest_periods, design.reference_delay_periods};
}

/// Without any pause where the design has none.
template <class Scalar>
typename control::PeriodicRelearning<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::PeriodicRelearning<Scalar>> /*part*/) {
  if (!design.relearns) {
    return {control::PeriodicRelearning<Scalar>::never, 0, {}, 1, 0, 1, {}};
  }
  return {design.relearn_every_periods,
          design.relearn_quiet_periods,
          scaled<Scalar>(design.relearn_travel),
          design.relearn_reading_periods,
          design.relearn_return_periods,
          design.relearn_average_periods,
          scaled<numeric::Accumulator<Scalar>>(design.relearn_weight)};
}

/// Wide open where the design has none.
template <class Scalar>
typename control::CurrentLimit<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::CurrentLimit<Scalar>> /*part*/) {
  const ResonantDesign& resonance = *design.resonance();
  constexpr double nothing = 1e-9;
  const double motional = resonance.current_limited ? resonance.motional : nothing;
  const double capacitive = resonance.current_limited ? resonance.capacitive : nothing;
  const double tangent = resonance.current_limited ? resonance.loss_tangent : 0.0;
  constexpr double regulated = 0.99;  // of the limit
  const double small = 0.25 / std::max({1.0, motional, capacitive});
  return {split<Scalar>(motional),
          split<Scalar>(1.0 / ((1.0 + tangent * tangent) * capacitive)),
          scaled<Scalar>(0.5 * tangent),
          scaled<Scalar>(small * motional),
          scaled<Scalar>(small * capacitive),
          scaled<Scalar>(small),
          scaled<Scalar>(small * regulated)};
}

template <class Scalar>
typename control::ResonanceEstimate<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::ResonanceEstimate<Scalar>> /*part*/) {
  const ResonantDesign& resonance = *design.resonance();
  return {split<Scalar>(resonance.rate),
          scaled_within<Scalar>(resonance.losses / 16.0),
          scaled<Scalar>(8.0 * resonance.natural),
          scaled<Scalar>(8.0 * resonance.lowest),
          scaled<Scalar>(8.0 * resonance.highest),
          scaled_within<Scalar>(2.0 * resonance.rate_gain),
          scaled<Scalar>(0.125 * resonance.losses_gain),
          scaled<Scalar>(resonance.natural_gain),
          scaled_within<Scalar>(resonance.audible),
          scaled_within<Scalar>(0.5 * resonance.surprise),
          scaled_within<Scalar>(0.5 * resonance.unrest)};
}

template <class Scalar, int MaxDelay, class Current>
typename control::ResonantVibration<Scalar, MaxDelay, Current>::Parameters parameters(
    const ControlDesign& design,
    Type<control::ResonantVibration<Scalar, MaxDelay, Current>> /*part*/) {
  constexpr double base = 8.0;  // of a deviation
  constexpr double turn = 6.283185307179586;
  const ResonantDesign& resonance = *design.resonance();
  return {parameters(design, Type<control::ResonanceEstimate<Scalar>>{}),
          {split<Scalar>(resonance.start_word / base), split<Scalar>(base / resonance.start_word)},
          parameters(design, Type<Current>{}),
          scaled<Scalar>(resonance.velocity_gain),
          scaled<Scalar>(base / turn * resonance.phase_gain),
          scaled<Scalar>(resonance.settled),
          scaled<Scalar>(std::min(0.5, resonance.missing)),
          resonance.delay_periods};
}

/// Smallest n > 0 with which 2^n is above twice these numbers of the rows: then the differences of
/// neighbours fit.
template <class Table>
std::uint8_t exponent_above(const Table& table, std::size_t begin, std::size_t end) {
  int exponent = 0;
  for (const auto& row : table) {
    for (std::size_t i = begin; i < end; ++i) {
      exponent = std::max(exponent, numeric::split(std::abs(row[i])).exponent);
    }
  }
  return static_cast<std::uint8_t>(exponent + 1);
}

template <class Scalar>
typename control::ModeObserver<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::ModeObserver<Scalar>> /*part*/) {
  namespace mode = control::mode;
  const DampedDesign& damping = *design.in_mode<DampedDesign>();
  typename control::ModeObserver<Scalar>::Parameters parameters{};
  std::array<int, mode::numbers> exponents{};
  const auto rebase = [&](std::size_t begin, std::size_t end) {
    const std::uint8_t exponent = exponent_above(damping.table, begin, end);
    std::fill(exponents.begin() + begin, exponents.begin() + end, exponent);
    return exponent;
  };
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    parameters.output_base = rebase(mode::output, mode::mode_gain);
    parameters.gain_base = rebase(mode::mode_gain, mode::feedback);
    parameters.feedback_base = rebase(mode::feedback, mode::inverse);
    parameters.inverse_base = rebase(mode::inverse, mode::numbers);
  }
  for (std::size_t row = 0; row < mode::rows; ++row) {
    for (std::size_t i = 0; i < mode::numbers; ++i) {
      parameters.table[row][i] = scaled_within<Scalar>(
          numeric::scale_by_power_of_two(damping.table[row][i], -exponents[i]));
    }
  }
  constexpr double finest = 0x1p-12;  // its square must not be lost in fixed point
  parameters.audible = scaled_within<Scalar>(std::max(finest, damping.audible));
  parameters.quiet = scaled_within<Scalar>(damping.quiet);
  return parameters;
}

template <class Scalar, int MaxDelay>
typename control::DampedVibration<Scalar, MaxDelay>::Parameters parameters(
    const ControlDesign& design, Type<control::DampedVibration<Scalar, MaxDelay>> /*part*/) {
  const DampedDesign& damping = *design.in_mode<DampedDesign>();
  return {parameters(design, Type<control::ModeObserver<Scalar>>{}),
          scaled_within<Scalar>(damping.settled), scaled_within<Scalar>(damping.missing),
          damping.delay_periods};
}

template <class Scalar>
typename control::LaggingReading<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::LaggingReading<Scalar>> /*part*/) {
  const auto lead = [](double memory) {
    return memory > 0.0 ? split<Scalar>(memory / (1.0 - memory)) : numeric::Split<Scalar>{};
  };
  const auto* feeling = design.in_mode<SensorlessDesign>();
  return {lead(feeling->sensor_memory), lead(feeling->contact_memory)};
}

/// Exponents of the numbers of a row, so that each fits; see SensorlessObserver::Parameters.
inline std::array<int, control::sensorless::numbers> sensorless_exponents(
    const control::SensorlessTable<double>& table, std::uint8_t& output, std::uint8_t& feedback,
    std::uint8_t& inverse) {
  namespace sensorless = control::sensorless;
  std::array<int, sensorless::numbers> exponents{};
  feedback = exponent_above(table, sensorless::feedback, sensorless::per_velocity);
  inverse = exponent_above(table, sensorless::per_velocity, sensorless::bend);
  output = 0;
  for (std::size_t node = 0; node < sensorless::nodes; ++node) {
    const std::size_t first = sensorless::plain + node * sensorless::per_node;
    output = std::max(output, exponent_above(table, first, first + sensorless::noise));
  }
  std::fill(&exponents[sensorless::feedback], &exponents[sensorless::per_velocity], feedback);
  exponents[sensorless::per_velocity] = inverse;
  for (std::size_t node = 0; node < sensorless::nodes; ++node) {
    int* const numbers = &exponents[sensorless::plain + node * sensorless::per_node];
    std::fill(numbers, numbers + sensorless::noise, output);
  }
  return exponents;
}

/// The powers of two in x >= 1; 0 below.
inline std::uint8_t powers_of_two_in(double x) {
  return static_cast<std::uint8_t>(std::max(0, numeric::split(x).exponent - 1));
}

/// @param velocity, mode  bases of SensorlessCovariance
template <class Scalar>
typename control::SensorlessCovariance<Scalar>::Parameters sensorless_covariance(double speed,
                                                                                 double swing,
                                                                                 double velocity,
                                                                                 double mode) {
  constexpr double mode_at_start = 0.03;  // all of them rms, per sliding velocity
  constexpr double offset_at_start = 0.05;
  constexpr double mode_per_period = 0.002;
  constexpr double offset_per_period = 0.007;
  constexpr double at_most = 2.0;
  const auto variance = [speed](double part, double base) {
    return scaled_within<Scalar>(part * part * speed * speed / (base * base));
  };
  return {variance(mode_at_start, mode),       variance(mode_per_period, mode),
          scaled<Scalar>(swing * swing),       variance(at_most, mode),
          variance(offset_at_start, velocity), variance(offset_per_period, velocity),
          variance(at_most, velocity)};
}

template <class Scalar>
typename control::SensorlessObserver<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::SensorlessObserver<Scalar>> /*part*/) {
  const SensorlessDesign& feeling = *design.in_mode<SensorlessDesign>();
  typename control::SensorlessObserver<Scalar>::Parameters parameters{};
  std::array<int, control::sensorless::numbers> exponents{};
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    exponents = sensorless_exponents(feeling.table, parameters.output_base,
                                     parameters.feedback_base, parameters.inverse_base);
    parameters.slower = powers_of_two_in(0.25 / feeling.speed);
    const double velocity = numeric::scale_by_power_of_two(1.0, -parameters.slower);
    parameters.quieter =
        std::min(powers_of_two_in(feeling.mode_unit / velocity),
                 static_cast<std::uint8_t>(parameters.output_base + parameters.slower));
  }
  for (std::size_t row = 0; row < control::sensorless::rows; ++row) {
    for (std::size_t i = 0; i < control::sensorless::numbers; ++i) {
      parameters.table[row][i] = scaled_within<Scalar>(
          numeric::scale_by_power_of_two(feeling.table[row][i], -exponents[i]));
    }
  }
  parameters.covariance = sensorless_covariance<Scalar>(
      feeling.speed, feeling.swing, numeric::scale_by_power_of_two(1.0, -parameters.slower),
      feeling.mode_unit * numeric::scale_by_power_of_two(1.0, -parameters.quieter));
  parameters.linear = split<Scalar>(feeling.linear);
  return parameters;
}

template <class Scalar, int MaxDelay, class Reading>
typename control::SensorlessVibration<Scalar, MaxDelay, Reading>::Parameters parameters(
    const ControlDesign& design,
    Type<control::SensorlessVibration<Scalar, MaxDelay, Reading>> /*part*/) {
  const SensorlessDesign& feeling = *design.in_mode<SensorlessDesign>();
  return {parameters(design, Type<control::SensorlessObserver<Scalar>>{}),
          parameters(design, Type<Reading>{}), feeling.backwards, feeling.delay_periods};
}

/// Of a part that judges readings of the force, where there are any.
template <class Parts, class Judge, class... Values>
typename Parts::Force::template Judge<Judge>::Parameters judge(Values... values) {
  if constexpr (Parts::Force::present) {
    return {values...};
  } else {
    return {};
  }
}

/// @tparam Parts  control::Parts: those that the design needs, or such as do their work
template <class Parts>
typename control::Controller<Parts>::Parameters controller_parameters(const ControlDesign& design) {
  using Scalar = typename Parts::Scalar;
  return {scaled<Scalar>(design.friction_force),
          scaled<Scalar>(design.smallest_friction),
          scaled<Scalar>(design.speed_floor),
          scaled<Scalar>(design.lead_periods / 64.0),
          parameters(design, Type<typename Parts::Friction>{}),
          parameters(design, Type<typename Parts::Feedforward>{}),
          parameters(design, Type<typename Parts::Slew>{}),
          parameters(design, Type<typename Parts::Shaper>{}),
          parameters(design, Type<typename Parts::Regulator>{}),
          parameters(design, Type<typename Parts::Relearning>{}),
          parameters(design, Type<typename Parts::Vibration>{}),
          {design.standstill_hold_periods, scaled<Scalar>(design.standstill_fall)},
          judge<Parts, control::StuckDetector<Scalar>>(design.stuck_periods),
          judge<Parts, control::Plausibility<Scalar>>(design.implausible_periods),
          judge<Parts, control::SettlingWatch<Scalar>>(scaled<Scalar>(design.settling_band),
                                                       design.settling_patience_periods,
                                                       scaled<Scalar>(design.agreement)),
          {},
          {}};
}

}  // namespace sonoglide::configure
