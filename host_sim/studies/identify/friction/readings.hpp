/// Measured friction under vibration.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host_sim/scene_file/source.hpp"

namespace sonoglide::identify::friction {

/// One measured mean friction.
struct Reading {
  double sliding_m_per_s;    ///< Vt, > 0
  double vibration_m_per_s;  ///< v̂, peak; 0: without vibration
  double frequency_Hz;       ///< 0: not known
  double friction;           ///< ratio, or force in N
  double standard_error;     ///< of the friction; 0: not known

  /// Vt/v̂; infinite without vibration.
  double velocity_ratio() const { return sliding_m_per_s / vibration_m_per_s; }
};

struct Readings {
  std::vector<Reading> rows;  ///< by rising velocity ratio, then sliding velocity
  bool are_forces = false;    ///< in N; otherwise ratios to the undriven friction
  bool have_frequency = false;
  bool have_standard_errors = false;
  double last_digit = 0.0;  ///< that the frictions are written with
  /// Least standard deviation of a reading: that of rounding to the last digit. Of n repeats of a single
  /// velocity that are off by the same rounding √n times it.
  double rounding = 0.0;
  std::vector<std::string> warnings;  ///< each a sentence

  /// Readings of different velocities or frequencies: repeated ones tell no further parameter.
  std::size_t distinct() const;
};

/// More are refused: a mean of readings at one velocity tells a fit as much.
inline constexpr std::size_t most_readings = 500;

/// Reads a table (MeasuredTable) with these columns in any order and no others:
/// - sliding_velocity_m_per_s;
/// - vibration_velocity_m_per_s (peak), or velocity_ratio, or vibration_amplitude_m with a
///   frequency;
/// - friction_ratio or friction_force_N;
/// - frequency_Hz, and friction_ratio_standard_error or friction_force_standard_error_N, if they
///   are known.
/// Without standard errors repeats that scatter by less than half their last digit are one reading, their
/// mean, where there are several velocities; a warning says so.
/// @throws scene_file::SceneError  at the place of what is wrong
Readings read_readings(const scene_file::Source& source);

}  // namespace sonoglide::identify::friction
