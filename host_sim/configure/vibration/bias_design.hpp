/// The bias against a slow natural mode.
#pragma once

#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/configure/vibration/mode_model.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Per unit of ControlScales, but for the limit.
struct BiasDesign {
  double limit_N = 0.0;  ///< the bias of 1
  double natural = 0.0;  ///< frequency, over that of the carrier
  double part = 0.0;     ///< g: of the mean velocity, that the bias takes away in a carrier period
  double per_force = 0.0;       ///< bias that balances a friction force of 1
  double gain = 0.0;            ///< bias that answers a mean velocity of 1
  double per_mode = 0.0;        ///< free velocity that a bias of 1 takes from Im w, see ModeModel
  double mean_of_first = 1.0;   ///< mean of the free velocity over a period: of Re w
  double mean_of_second = 0.0;  ///< likewise of Im w
};

/// The largest g with which b = -g m v̄/T is stable, v̄ the mean velocity of a period and b in force
/// `delay_periods` + 1 periods later:
///   g < φ²/(1 - cos φ) (cos φ - cos θ)/sin θ,   θ = π/(2 (delay_periods + 1)),
/// φ = ωn T. At φ = 0 this is 2 tan(θ/2). 0 or less where φ >= θ: there the delay turns the damper round.
/// @param natural_per_carrier  φ/2π, > 0
double largest_bias_part(double natural_per_carrier, int delay_periods);

/// The natural frequency over that of the carrier, below which a bias damps.
double fastest_biased_mode(int delay_periods);

/// A limit with which a bias is seldom at its end: twice the friction, which pushes the mass, and what
/// answers the free motion that full drive leaves when it begins.
/// @param scene  has the vibration control that the bias is for
double wanted_bias_N(const scene::Scene& scene, const NominalPlant& plant);

/// Of a scene with a bias limit.
/// @param resonator  the nominal one, with velocities per velocity_m_per_s
/// @param force_N    base of the friction force
/// @throws ConfigurationError  the mode is too fast for the delay, or too slow for a sensorless loop to
///         tell
BiasDesign design_bias(const scene::Scene& scene, const NominalPlant& plant,
                       const Resonator& resonator, double force_N);

}  // namespace sonoglide::configure
