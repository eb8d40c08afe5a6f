/// A mode that is felt in the friction, for the tests of its observer and of what stands on it.
#pragma once

#include <cmath>
#include <cstddef>

#include "firmware/control/vibration/sensorless_observer.hpp"
#include "scalars.hpp"

namespace sonoglide::control::sensorless_design {

inline constexpr double speed = 0.1;
inline constexpr double forced = 0.25;  ///< velocity at full drive
inline constexpr double amplitude = 0.6;
inline constexpr double middle = 1.36;  ///< angle of a period, of the row in the middle
inline constexpr double per_frequency_parameter = 0.04;
inline constexpr double input_gain = 0.125;
inline constexpr double output = 0.4;

/// The angle at a place.
inline double angle(double frequency_parameter) {
  return middle + per_frequency_parameter * frequency_parameter;
}

/// SensorlessCovariance has velocities on this base in fixed point.
inline constexpr double velocity_base = 0.5;

/// @param wrong  what the model has wrong, of what is usual
template <class S>
typename SensorlessCovariance<S>::Parameters covariance(double wrong) {
  const double base = numeric::is_fixed_point_v<S> ? velocity_base : 1.0;
  const auto variance = [](double rms) { return scaled<S>(rms * rms); };
  return {variance(0.05),      variance(2e-4 * wrong), variance(0.02 * wrong),
          variance(0.4),       variance(0.01 / base),  variance(7e-4 * wrong / base),
          variance(0.2 / base)};
}

/// A mode whose first coordinate is felt, and no more.
template <class S>
typename SensorlessObserver<S>::Parameters parameters(double noise, double wrong = 1.0) {
  typename SensorlessObserver<S>::Parameters all{};
  for (std::size_t i = 0; i < SensorlessIndex::rows; ++i) {
    const double frequency_parameter =
        2.0 * static_cast<double>(i) / (SensorlessIndex::rows - 1) - 1.0;
    SensorlessRow<S>& row = all.table[i];
    row[SensorlessIndex::rotation] = scaled<S>(std::cos(angle(frequency_parameter)));
    row[SensorlessIndex::rotation + 1] = scaled<S>(std::sin(angle(frequency_parameter)));
    row[SensorlessIndex::input_gain + 1] = scaled<S>(input_gain);
    row[SensorlessIndex::forced] = scaled<S>(forced);
    for (std::size_t node = 0; node < SensorlessIndex::nodes; ++node) {
      S* const numbers = &row[SensorlessIndex::plain + node * SensorlessIndex::Node::count];
      numbers[SensorlessIndex::Node::output] = scaled<S>(output);
      numbers[SensorlessIndex::Node::noise] = scaled<S>(noise);
    }
  }
  all.covariance = covariance<S>(wrong);
  all.slower = numeric::is_fixed_point_v<S> ? 1 : 0;
  all.linear = {scaled<S>(0.5), 3};
  return all;
}

}  // namespace sonoglide::control::sensorless_design
