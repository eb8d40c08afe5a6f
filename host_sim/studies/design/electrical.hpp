/// What a design asks of the amplifier, where the drive is a transducer.
#pragma once

#include "host_sim/loop/electrical.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/design/requirement.hpp"

namespace sonoglide::design {

/// The scene has a transducer, in all of these.

/// k_eff² = Cm/(C0 + Cm), Cm = Nf²/Ks: the part of the energy that takes part in the exchange
/// between voltage and motion.
double coupling_square(const scene::Scene& scene);

/// √(Ks/m)/2π, where the transducer conducts most; 0 without a spring.
double series_resonance_Hz(const scene::Scene& scene);
/// fs √(1 + Cm/C0), where it conducts least.
double parallel_resonance_Hz(const scene::Scene& scene);

/// V̂²|Y|/2, Y the admittance while the mass is held: what the clamped capacitance takes alone.
double clamped_power_VA(const scene::Scene& scene, double voltage_V);

/// L = V̂²/(2 ω |Q|): beside the transducer it takes the reactive power Q of its fundamental away;
/// NaN where that is not capacitive.
double matching_inductance_H(const scene::Scene& scene, const loop::ElectricalFigures& figures);

/// The spring that puts the natural frequency on the carrier, and what a ratio then takes.
struct ResonantSpring {
  double stiffness_N_per_m;  ///< m ω²
  Requirement requirement;
};

ResonantSpring on_resonance(const scene::Scene& scene, const Requirement& requirement);

}  // namespace sonoglide::design
