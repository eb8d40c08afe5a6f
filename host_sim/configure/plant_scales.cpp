#include "host_sim/configure/plant_scales.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::configure {
namespace {

double own_rate_rad_per_s(const scene::Load& load, double contact_stiffness_N_per_m) {
  const double stiffness_N_per_m = std::max(load.spring_N_per_m, contact_stiffness_N_per_m);
  return std::max(std::sqrt(stiffness_N_per_m / load.mass_kg),
                  load.damping_N_s_per_m / load.mass_kg);
}

/// Without a drive the clock is the fastest of the plant's own rates; one run where it has none.
double own_rate_rad_per_s(const scene::Scene& scene) {
  const scene::Plant& plant = scene.plant;
  const double contact = scene.friction.contact_stiffness_N_per_m;
  const double rate =
      std::max(std::sqrt(std::max(plant.stiffness_N_per_m, contact) / plant.mass_kg),
               plant.damping_N_s_per_m / plant.mass_kg);
  const double fastest =
      scene.load ? std::max(rate, own_rate_rad_per_s(*scene.load, contact)) : rate;
  return fastest > 0.0 ? fastest : numeric::two_pi / scene.run.duration_s;
}

/// Size of the motion to come: the largest that the drive, the friction or the initial state can
/// cause away from resonance. Sliding alone moves nothing; its speed serves where nothing else
/// does.
double motion_m(const scene::Scene& scene, double omega) {
  const scene::Plant& plant = scene.plant;
  const double resistance_N_per_m =
      plant.stiffness_N_per_m + omega * (plant.mass_kg * omega + plant.damping_N_s_per_m);
  const double drive_N =
      scene.drive ? std::max(scene.drive_force_N(), scene.max_drive_force_N()) : 0.0;
  const double force_N = std::max(drive_N, scene.friction.limit_N());
  const double motion =
      std::max({force_N / resistance_N_per_m, std::abs(plant.initial_velocity_m_per_s) / omega,
                std::abs(plant.initial_displacement_m)});
  const double sliding_m_per_s = scene.sliding.fastest_m_per_s();
  if (motion > 0.0) {
    return motion;
  }
  return sliding_m_per_s > 0.0 ? sliding_m_per_s / omega : 1.0;  // nothing moves: any will do
}

}  // namespace

std::complex<double> dynamic_stiffness(const scene::Plant& plant, double omega_rad_per_s) {
  return {plant.stiffness_N_per_m - plant.mass_kg * omega_rad_per_s * omega_rad_per_s,
          plant.damping_N_s_per_m * omega_rad_per_s};
}

double dynamic_stiffness_N_per_m(const scene::Plant& plant, double omega_rad_per_s) {
  // The same bits on every machine, unlike std::abs.
  const std::complex<double> stiffness = dynamic_stiffness(plant, omega_rad_per_s);
  return numeric::sqrt(stiffness.real() * stiffness.real() + stiffness.imag() * stiffness.imag());
}

double peak_vibration_m_per_s(const scene::Plant& plant, double frequency_Hz,
                              double force_amplitude_N) {
  const double omega = numeric::two_pi * frequency_Hz;
  return force_amplitude_N * omega / dynamic_stiffness_N_per_m(plant, omega);
}

double carrier_frequency_Hz(const scene::Drive& drive, double time_s) {
  return drive.frequency_profile.empty()
             ? drive.frequency_Hz
             : drive.nearest_frequency_Hz(scene::value_at(drive.frequency_profile, time_s));
}

scene::ContactValues contact_at(const scene::Friction& friction, double time_s) {
  const scene::ContactValues& held = friction;
  scene::ContactValues contact = held;
  if (!friction.coefficient_profile.empty()) {
    contact.coefficient = scene::value_at(friction.coefficient_profile, time_s);
  }
  if (!friction.normal_force_profile_N.empty()) {
    contact.normal_force_N = scene::value_at(friction.normal_force_profile_N, time_s);
  }
  return contact;
}

scene::FrictionLaw acting_law(const scene::Friction& friction) {
  return friction.limit_N() > 0.0 ? friction.law : scene::laws::None{};
}

scene::PlantScales plant_scales(const scene::Scene& scene) {
  const double omega = scene.drive ? scene.drive->rate_rad_per_s() : own_rate_rad_per_s(scene);
  const double length_m = motion_m(scene, omega);
  return {omega, length_m, scene.plant.mass_kg * length_m * omega * omega,
          scene.friction.limit_N()};
}

PlantNumbers plant_numbers(const scene::Scene& scene, const scene::PlantScales& scales) {
  const double omega = scales.angular_frequency_rad_per_s;
  const double inertia = scene.plant.mass_kg * omega;
  const bool elastic = scene::is_elastic(scene.friction.law) && scales.friction_N > 0.0;
  return {scene.plant.stiffness_N_per_m / (inertia * omega),
          scene.plant.damping_N_s_per_m / inertia, scales.friction_N / scales.force_N,
          elastic ? scales.contact_stiffness(scene.friction.contact_stiffness_N_per_m) : 0.0};
}

plant::State<double> initial_state(const scene::Scene& scene, const scene::PlantScales& scales) {
  return {scene.plant.initial_displacement_m / scales.length_m,
          scene.plant.initial_velocity_m_per_s / scales.velocity_m_per_s(),
          scales.friction_N > 0.0 ? scene.friction.initial_force_N / scales.friction_N : 0.0};
}

LoadNumbers load_numbers(const scene::Load& load, double mass_kg,
                         const scene::PlantScales& scales) {
  const double omega = scales.angular_frequency_rad_per_s;
  const double inertia = load.mass_kg * omega;
  return {mass_kg / load.mass_kg, load.damping_N_s_per_m / inertia,
          load.spring_N_per_m / (inertia * omega)};
}

plant::LoadedState<double> initial_loaded_state(const scene::Scene& scene,
                                                const scene::PlantScales& scales) {
  return {initial_state(scene, scales),
          scene.load->initial_velocity_m_per_s / scales.velocity_m_per_s(), 0.0};
}

}  // namespace sonoglide::configure
