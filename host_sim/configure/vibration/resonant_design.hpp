/// The numbers of a loop that holds the vibration at the plant's resonance.
#pragma once

#include <cstdint>

#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Real numbers, per unit of ControlScales, on the bases of control::ResonantVibration and its
/// parts; a frequency is a deviation from the start, relative to it.
struct ResonantDesign {
  double rate = 0.0;            ///< velocity that full drive adds in a carrier period
  double losses = 0.0;          ///< amplitude that holds a velocity of 1
  double quality_factor = 0.0;  ///< nominal
  double head_room = 0.0;       ///< velocity at full drive over that of the lowest target; nominal
  double natural = 0.0;
  double nominal_natural = 0.0;  ///< deviation; `natural` is in the range
  double lowest = 0.0;
  double highest = 0.0;
  double noise = 0.0;  ///< of a vibration sample, converter included, rms
  double rate_gain = 0.0;
  double losses_gain = 0.0;
  double quiet_losses = 0.0;  ///< part of a miss within `unrest` that counts for the losses
  double natural_gain = 0.0;
  double audible = 0.0;
  double surprise = 0.0;  ///< drive that a period may seem to have missed
  double unrest = 0.0;    ///< drive that noise alone may ask for
  double velocity_gain = 0.0;
  double calm = 0.0;        ///< part of a velocity error within `quiet` that is left to be
  double quiet = 0.0;       ///< largest velocity error that noise may be
  double phase_gain = 0.0;  ///< radians of phase taken away in a period, per radian
  double settled = 0.0;
  double missing = 0.0;
  bool scales = false;  ///< what reads the vibration rests on a force factor
  std::uint8_t delay_periods = 1;

  double step_Hz = 0.0;          ///< of the frequency word
  std::uint32_t start_word = 0;  ///< frequency of the start in such steps

  bool current_limited = false;
  double motional = 0.0;    ///< current of a velocity of 1 over the limit
  double capacitive = 0.0;  ///< that of the clamped capacitance at full drive, likewise
  double loss_tangent = 0.0;

  /// In which the loop follows a small change of its velocity.
  static constexpr double following_periods = 3.0;
  /// Until full drive has built up a change of the vibration.
  double changing_periods() const;
  /// Six time constants of the resonance.
  double building_up_periods() const { return 2.0 * quality_factor; }
  static constexpr bool tells_mismatch() { return true; }
};

/// The range of the vibration sensor.
double resonant_full_scale_m_per_s(const scene::Scene& scene, const NominalPlant& plant);

/// @throws ConfigurationError  a target needs more than the vibration sensor reads
void require_needed_range(const scene::Scene& scene, const NominalPlant& plant,
                          double full_scale_m_per_s);

/// @param full_scale_m_per_s  of the vibration sensor
/// @throws ConfigurationError  no spring, no damping; a drive too strong for the sensor's range; a
///                             vibration that noise hides; a current limit that no target's
///                             voltage keeps, or that a lossy capacitance makes no sense of
ResonantDesign design_resonance(const scene::Scene& scene, const NominalPlant& plant,
                                double full_scale_m_per_s);

}  // namespace sonoglide::configure
