/// From a scene to the plant's dimensionless numbers: the only place where the plant's units become
/// scaled numbers.
#pragma once

#include <complex>

#include "firmware/plant/state.hpp"
#include "host_sim/scene/contact.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// The plant's dimensionless parameters (see plant::Model).
struct PlantNumbers {
  double stiffness;          ///< k = Ks/(m ω²)
  double damping;            ///< d = c/(m ω)
  double friction_force;     ///< β = Fc/(m L ω²)
  double contact_stiffness;  ///< κ = Kt L/Fc, 0 where the law has none
};

/// Of a load (see plant::LoadedModel).
struct LoadNumbers {
  double mass_ratio;  ///< m/M
  double damping;     ///< c/(M ω)
  double stiffness;   ///< k/(M ω²)
};

scene::PlantScales plant_scales(const scene::Scene& scene);
PlantNumbers plant_numbers(const scene::Scene& scene, const scene::PlantScales& scales);

LoadNumbers load_numbers(const scene::Load& load, double mass_kg, const scene::PlantScales& scales);

/// Where the run begins, in the same units.
plant::State<double> initial_state(const scene::Scene& scene, const scene::PlantScales& scales);
/// The same with a load.
plant::LoadedState<double> initial_loaded_state(const scene::Scene& scene,
                                                const scene::PlantScales& scales);

/// σ in V = Vt + σ x': +1 dissipative, −1 as printed.
constexpr double vibration_sign(scene::SignConvention convention) {
  return convention == scene::SignConvention::dissipative ? 1.0 : -1.0;
}

/// Ks − m ω² + i c ω [N/m]: force over displacement of the steady vibration at ω [rad/s], without a
/// contact, as phasors; 0 at the resonance of an undamped plant.
std::complex<double> dynamic_stiffness(const scene::Plant& plant, double omega_rad_per_s);
/// Its magnitude [N/m].
double dynamic_stiffness_N_per_m(const scene::Plant& plant, double omega_rad_per_s);

/// Peak vibration velocity v̂ = Fe ω / |Ks − m ω² + i c ω| [m/s] of the steady vibration under a
/// drive of this frequency and force amplitude, without a contact; infinite or not a number at an
/// undamped resonance.
double peak_vibration_m_per_s(const scene::Plant& plant, double frequency_Hz,
                              double force_amplitude_N);

/// The carrier frequency that a drive of open loop has from a phase 0 at this time on.
double carrier_frequency_Hz(const scene::Drive& drive, double time_s);

/// The contact at a time since the run began.
scene::ContactValues contact_at(const scene::Friction& friction, double time_s);

/// Without a friction force there is no friction, whatever the law.
scene::FrictionLaw acting_law(const scene::Friction& friction);

}  // namespace sonoglide::configure
