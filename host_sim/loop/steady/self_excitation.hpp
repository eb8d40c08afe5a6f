/// Whether steady sliding stays steady, or feeds a vibration of its own: squeal, stick-slip.
#pragma once

#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::steady {

/// What becomes of a small deviation from steady sliding.
enum class Fate {
  dies_out,
  stays,    ///< its Floquet multiplier is 1 within the rounding: nothing damps it
  grows,    ///< self-excited oscillation
  unknown,  ///< no steady motion was found
};

const char* name(Fate fate);

/// By averaging, in a carrier period: under a drive where a deviation grows by more than that, no steady
/// motion is looked for. A search that follows the motion for a period loses it there, and takes all its
/// steps before it says so.
inline constexpr double largest_growth = 1e6;

/// Steady sliding under a drive of constant amplitude.
struct SteadySliding {
  double sliding_m_per_s = 0.0;
  double drive_force_N = 0.0;      ///< amplitude
  double vibration_m_per_s = 0.0;  ///< peak velocity that the force gives without a contact
  /// Largest modulus of a Floquet multiplier of the steady motion: by what a small deviation is
  /// multiplied in a carrier period. NaN where no steady motion was found, or looked for.
  double multiplier = 0.0;
  /// The same by averaging over the drive: the mean friction is a force that changes with the sliding
  /// velocity, and the natural mode is slow and obeys m x'' + (c + dF/dVt) x' + Ks x = 0. Wrong where
  /// the mode is not slow, and where the friction bends the driven motion.
  double averaged_multiplier = 0.0;

  Fate fate() const;
  Fate averaged_fate() const;
};

/// Whether the friction of steady sliding falls with the velocity somewhere: without that no sliding
/// excites itself. Of the laws that have no static friction above the sliding one, false.
bool friction_falls(const scene::Friction& friction);

/// @param scene            with a drive of a cosine and without profiles
/// @param sliding_m_per_s  > 0
/// @param drive_force_N    >= 0
/// Error: multiplier 1e-6.
SteadySliding steady_sliding(const scene::Scene& scene, double sliding_m_per_s,
                             double drive_force_N);

/// Magnitude of the rate that friction and damper give a deviation without a drive, |c + dF/dVt|/m, times
/// a carrier period: above some tens a carrier period is long against it.
double undriven_exponent(const scene::Scene& scene, double sliding_m_per_s);

/// A range of drives of one fate.
struct DriveWindow {
  double low_N;
  double high_N;
  Fate fate;
};

/// A scan for windows goes from no drive to the strongest by equal steps; above a hundredth of the force at
/// which the sliding begins to reverse no step is longer than this part of its force.
inline constexpr int scan_steps = 96;
inline constexpr double narrowest_part = 0.1;

/// From no drive to the strongest, by rising force; neighbours have different fates.
/// @param most_N  > 0
/// Error: edges where the multiplier is within 1e-6 of 1. A window narrower than most_N/scan_steps and
/// than narrowest_part of its force may be missed where the averaged multiplier does not have it too.
std::vector<DriveWindow> drive_windows(const scene::Scene& scene, double sliding_m_per_s,
                                       double most_N);

/// The same by the averaged multiplier, whose extremes are looked for between the places of a finer scan.
std::vector<DriveWindow> averaged_drive_windows(const scene::Scene& scene, double sliding_m_per_s,
                                                double most_N);

}  // namespace sonoglide::steady
