/// Parameters of the parts that drive the vibration, in a controller's own scalar.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "firmware/control/limits/current_limit.hpp"
#include "firmware/control/vibration/biased_damping.hpp"
#include "firmware/control/vibration/damped_vibration.hpp"
#include "firmware/control/vibration/resonant_vibration.hpp"
#include "firmware/control/vibration/sensorless_vibration.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/part_parameters.hpp"

namespace sonoglide::configure {

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
  typename control::CurrentLimit<Scalar>::Parameters all{};
  all.motional = split<Scalar>(motional);
  all.inverse = split<Scalar>(1.0 / ((1.0 + tangent * tangent) * capacitive));
  all.loss_tangent = scaled<Scalar>(0.5 * tangent);
  all.small_motional = scaled<Scalar>(small * motional);
  all.small_capacitive = scaled<Scalar>(small * capacitive);
  all.small_whole = scaled<Scalar>(small);
  all.small_limit = scaled<Scalar>(small * regulated);
  return all;
}

template <class Scalar>
typename control::ResonanceEstimate<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::ResonanceEstimate<Scalar>> /*part*/) {
  const ResonantDesign& resonance = *design.resonance();
  typename control::ResonanceEstimate<Scalar>::Parameters all{};
  all.rate = split<Scalar>(resonance.rate);
  all.losses = scaled_within<Scalar>(resonance.losses / 16.0);
  all.natural = scaled<Scalar>(8.0 * resonance.natural);
  all.lowest = scaled<Scalar>(8.0 * resonance.lowest);
  all.highest = scaled<Scalar>(8.0 * resonance.highest);
  all.rate_gain = scaled_within<Scalar>(2.0 * resonance.rate_gain);
  all.losses_gain = scaled<Scalar>(0.125 * resonance.losses_gain);
  all.quiet_losses = scaled_within<Scalar>(resonance.quiet_losses);
  all.natural_gain = scaled<Scalar>(resonance.natural_gain);
  all.audible = scaled_within<Scalar>(resonance.audible);
  all.surprise = scaled_within<Scalar>(0.5 * resonance.surprise);
  all.unrest = scaled_within<Scalar>(0.5 * resonance.unrest);
  return all;
}

template <class Scalar, int MaxDelay, class Current>
typename control::ResonantVibration<Scalar, MaxDelay, Current>::Parameters parameters(
    const ControlDesign& design,
    Type<control::ResonantVibration<Scalar, MaxDelay, Current>> /*part*/) {
  constexpr double base = 8.0;  // of a deviation
  const ResonantDesign& resonance = *design.resonance();
  typename control::ResonantVibration<Scalar, MaxDelay, Current>::Parameters all{};
  all.resonance = parameters(design, Type<control::ResonanceEstimate<Scalar>>{});
  all.word.steps = split<Scalar>(resonance.start_word / base);
  all.word.deviation = split<Scalar>(base / resonance.start_word);
  all.current = parameters(design, Type<Current>{});
  all.velocity_gain = scaled<Scalar>(resonance.velocity_gain);
  all.calm = scaled<Scalar>(resonance.calm);
  all.quiet = scaled_within<Scalar>(resonance.quiet);
  all.phase_gain = scaled<Scalar>(base / numeric::two_pi * resonance.phase_gain);
  all.settled = scaled<Scalar>(resonance.settled);
  all.missing = scaled<Scalar>(std::min(0.5, resonance.missing));
  all.delay = resonance.delay_periods;
  return all;
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
  typename control::DampedVibration<Scalar, MaxDelay>::Parameters all{};
  all.observer = parameters(design, Type<control::ModeObserver<Scalar>>{});
  all.settled = scaled_within<Scalar>(damping.settled);
  all.missing = scaled_within<Scalar>(damping.missing);
  all.delay = damping.delay_periods;
  return all;
}

template <class Scalar>
typename control::LaggingReading<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::LaggingReading<Scalar>> /*part*/) {
  const auto lead = [](double memory) {
    return memory > 0.0 ? split<Scalar>(memory / (1.0 - memory)) : numeric::Split<Scalar>{};
  };
  const SensorlessDesign& sensorless = *design.in_mode<SensorlessDesign>();
  return {lead(sensorless.sensor_memory), lead(sensorless.contact_memory)};
}

/// Exponents of the numbers of a row, so that each fits; see SensorlessObserver::Parameters.
inline std::array<int, control::SensorlessIndex::count> sensorless_exponents(
    const control::SensorlessTable<double>& table, std::uint8_t& output, std::uint8_t& feedback,
    std::uint8_t& inverse) {
  using Index = control::SensorlessIndex;
  std::array<int, Index::count> exponents{};
  feedback = exponent_above(table, Index::feedback, Index::per_velocity);
  inverse = exponent_above(table, Index::per_velocity, Index::bend);
  output = 0;
  for (std::size_t node = 0; node < Index::nodes; ++node) {
    const std::size_t first = Index::plain + node * Index::Node::count;
    output = std::max(output, exponent_above(table, first, first + Index::Node::noise));
  }
  std::fill(&exponents[Index::feedback], &exponents[Index::per_velocity], feedback);
  exponents[Index::per_velocity] = inverse;
  for (std::size_t node = 0; node < Index::nodes; ++node) {
    int* const numbers = &exponents[Index::plain + node * Index::Node::count];
    std::fill(numbers, numbers + Index::Node::noise, output);
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
  typename control::SensorlessCovariance<Scalar>::Parameters all{};
  all.mode_at_start = variance(mode_at_start, mode);
  all.mode_per_period = variance(mode_per_period, mode);
  all.mode_swing = scaled<Scalar>(swing * swing);
  all.mode_at_most = variance(at_most, mode);
  all.offset_at_start = variance(offset_at_start, velocity);
  all.offset_per_period = variance(offset_per_period, velocity);
  all.offset_at_most = variance(at_most, velocity);
  return all;
}

template <class Scalar>
typename control::SensorlessObserver<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::SensorlessObserver<Scalar>> /*part*/) {
  const SensorlessDesign& sensorless = *design.in_mode<SensorlessDesign>();
  typename control::SensorlessObserver<Scalar>::Parameters parameters{};
  std::array<int, control::SensorlessIndex::count> exponents{};
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    exponents = sensorless_exponents(sensorless.table, parameters.output_base,
                                     parameters.feedback_base, parameters.inverse_base);
    parameters.slower = powers_of_two_in(0.25 / sensorless.speed);
    const double velocity = numeric::scale_by_power_of_two(1.0, -parameters.slower);
    parameters.quieter =
        std::min(powers_of_two_in(sensorless.mode_unit / velocity),
                 static_cast<std::uint8_t>(parameters.output_base + parameters.slower));
  }
  for (std::size_t row = 0; row < control::SensorlessIndex::rows; ++row) {
    for (std::size_t i = 0; i < control::SensorlessIndex::count; ++i) {
      parameters.table[row][i] = scaled_within<Scalar>(
          numeric::scale_by_power_of_two(sensorless.table[row][i], -exponents[i]));
    }
  }
  parameters.covariance = sensorless_covariance<Scalar>(
      sensorless.speed, sensorless.swing, numeric::scale_by_power_of_two(1.0, -parameters.slower),
      sensorless.mode_unit * numeric::scale_by_power_of_two(1.0, -parameters.quieter));
  parameters.linear = split<Scalar>(sensorless.linear);
  return parameters;
}

template <class Scalar, int MaxDelay, class Reading>
typename control::SensorlessVibration<Scalar, MaxDelay, Reading>::Parameters parameters(
    const ControlDesign& design,
    Type<control::SensorlessVibration<Scalar, MaxDelay, Reading>> /*part*/) {
  const SensorlessDesign& sensorless = *design.in_mode<SensorlessDesign>();
  typename control::SensorlessVibration<Scalar, MaxDelay, Reading>::Parameters all{};
  all.observer = parameters(design, Type<control::SensorlessObserver<Scalar>>{});
  all.reading = parameters(design, Type<Reading>{});
  all.backwards = sensorless.backwards;
  all.delay = sensorless.delay_periods;
  return all;
}

template <class Scalar, int MaxDelay>
typename control::BiasedDampedVibration<Scalar, MaxDelay>::Parameters parameters(
    const ControlDesign& design, Type<control::BiasedDampedVibration<Scalar, MaxDelay>> /*part*/) {
  return {parameters(design, Type<control::DampedVibration<Scalar, MaxDelay>>{}),
          {split<Scalar>(design.bias->gain)},
          {split<Scalar>(design.bias->per_force)}};
}

template <class Scalar>
typename control::BalancedFedForward<Scalar>::Parameters parameters(
    const ControlDesign& design, Type<control::BalancedFedForward<Scalar>> /*part*/) {
  return {split<Scalar>(design.bias->per_force)};
}

template <class Scalar, int MaxDelay, class Reading>
typename control::BiasedSensorlessVibration<Scalar, MaxDelay, Reading>::Parameters parameters(
    const ControlDesign& design,
    Type<control::BiasedSensorlessVibration<Scalar, MaxDelay, Reading>> /*part*/) {
  const double mode_unit = design.in_mode<SensorlessDesign>()->mode_unit;
  typename control::BiasedSensorlessVibration<Scalar, MaxDelay, Reading>::Parameters all{};
  all.vibration =
      parameters(design, Type<control::SensorlessVibration<Scalar, MaxDelay, Reading>>{});
  all.bias = {split<Scalar>(design.bias->gain * mode_unit)};
  all.balance = {split<Scalar>(design.bias->per_force)};
  all.mean_of_first = scaled_within<Scalar>(design.bias->mean_of_first);
  all.mean_of_second = scaled_within<Scalar>(design.bias->mean_of_second);
  all.displacement = split<Scalar>(2.0 * design.bias->per_mode / mode_unit);
  return all;
}

}  // namespace sonoglide::configure
