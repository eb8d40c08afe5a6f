/// What a loop off resonance with the force sensor alone does best with, by its nominal mode and its law.
#pragma once

#include <string_view>

namespace sonoglide::configure {

/// The rows of the table "Which controller" (firmware/control/vibration.md), in their order: the first that
/// holds.
enum class ModeKind {
  across,     ///< the vibration is not along the sliding: the friction does not show it
  slowest,    ///< no reading tells the mode from the vibration, but a balance needs none
  slow,       ///< the friction itself moves the mass
  twice,      ///< beside twice the carrier
  multiple,   ///< beside a higher multiple of it
  unquiet,    ///< from 3.2 to 3.5 times the carrier, where a ramp of 8 codes leaves most
  fast,       ///< a small part of its stiffness turns it by much in a period
  half_turn,  ///< its direction of rotation is unobservable
  other
};

struct RecommendedMeans {
  ModeKind kind = ModeKind::other;
  bool sensorless = false;  ///< controller.vibration = "damped"
  bool biased = false;      ///< drive.bias_limit_N
  int codes_per_period = 1;
  double shaping_range = 0.0;  ///< controller.shaping = "robust" for it; 0: as the design chooses

  /// drive.interpolation = "linear".
  bool ramped() const { return !sensorless && !biased; }
};

/// Natural over carrier frequency, below which the friction itself moves the mass.
inline constexpr double slow_mode = 0.09;

/// The same, from which on a sensorless loop tells a mode from the vibration, however its stiffness is off.
inline constexpr double told_mode = 1.03 / 192.0;

/// @param natural_per_carrier  nominal natural over carrier frequency, off resonance; > 0
/// @param along                the vibration is along the sliding
RecommendedMeans recommended_means(double natural_per_carrier, bool along);

/// Why a mode of this kind has these means; begins a part of a sentence.
std::string_view reason(ModeKind kind);

}  // namespace sonoglide::configure
