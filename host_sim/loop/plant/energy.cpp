#include "host_sim/loop/plant/energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::loop {
namespace {

double quotient(double numerator, double denominator) {
  return denominator > 0.0 ? numerator / denominator : std::numeric_limits<double>::quiet_NaN();
}

/// @param scale_J  energy of the motion to come: what the rounding of a work is relative to
/// @param has_load  the work of the pull comes from a load
double balance_residual(const EnergyBalance& energy, double sign, double scale_J, bool has_load) {
  constexpr double rounding = 1e-13;
  constexpr double least_part_of_stored = 1e-9;
  const LoadBalance& load = energy.load;
  const double change = energy.stored_end_J - energy.stored_begin_J;
  const double from_sliding =
      has_load ? load.force_work_J + load.spring_pull_work_J - load.damping_work_J - load.change_J()
               : energy.pull_work_J;
  const double residual = std::abs(
      energy.friction_work_J - from_sliding -
      sign * (energy.drive_work_J + energy.spring_work_J - energy.damping_work_J - change));
  const double largest = std::max({std::abs(energy.friction_work_J), std::abs(energy.pull_work_J),
                                   std::abs(energy.drive_work_J), std::abs(energy.spring_work_J),
                                   std::abs(energy.damping_work_J), std::abs(change),
                                   std::abs(load.force_work_J), std::abs(load.spring_pull_work_J),
                                   std::abs(load.damping_work_J), std::abs(load.change_J())});
  const double stored = std::max(
      {energy.stored_begin_J, energy.stored_end_J, load.stored_begin_J, load.stored_end_J});
  return quotient(residual, std::max(largest, stored) <= rounding * scale_J ? 0.0
                            : largest < least_part_of_stored * stored       ? stored
                                                                            : largest);
}

}  // namespace

void EnergyBalance::append(const EnergyBalance& next) {
  if (duration_s == 0.0) {
    stored_begin_J = next.stored_begin_J;
    load.stored_begin_J = next.load.stored_begin_J;
  }
  stored_end_J = next.stored_end_J;
  load.stored_end_J = next.load.stored_end_J;
  add(next, 1.0);
}

void EnergyBalance::add(const EnergyBalance& other, double times) {
  duration_s += times * other.duration_s;
  sliding_distance_m += times * other.sliding_distance_m;
  friction_impulse_N_s += times * other.friction_impulse_N_s;
  resistance_impulse_N_s += times * other.resistance_impulse_N_s;
  undriven_s += times * other.undriven_s;
  limit_distance_m += times * other.limit_distance_m;
  friction_work_J += times * other.friction_work_J;
  pull_work_J += times * other.pull_work_J;
  drive_work_J += times * other.drive_work_J;
  damping_work_J += times * other.damping_work_J;
  spring_work_J += times * other.spring_work_J;
  stored_integral_J_s += times * other.stored_integral_J_s;
  momentum_integral_J_s += times * other.momentum_integral_J_s;
  displacement_square_m2_s += times * other.displacement_square_m2_s;
  velocity_square_m2_per_s += times * other.velocity_square_m2_per_s;
  velocity_in_phase_m += times * other.velocity_in_phase_m;
  velocity_quadrature_m += times * other.velocity_quadrature_m;
  velocity_in_phase_moment_m += times * other.velocity_in_phase_moment_m;
  velocity_quadrature_moment_m += times * other.velocity_quadrature_moment_m;
  load_s += times * other.load_s;
  normal_impulse_N_s += times * other.normal_impulse_N_s;
  open_s += times * other.open_s;
  load.force_work_J += times * other.load.force_work_J;
  load.spring_pull_work_J += times * other.load.spring_pull_work_J;
  load.damping_work_J += times * other.load.damping_work_J;
}

std::complex<double> EnergyBalance::vibration_m_per_s() const {
  return 2.0 / duration_s * std::complex<double>(velocity_in_phase_m, -velocity_quadrature_m);
}

namespace {

PowerRatios ratios(const EnergyBalance& energy, double friction_N, scene::SignConvention convention,
                   double period_s, double scale_J, bool has_load) {
  const double sign = configure::vibration_sign(convention);
  const double limit_J = friction_N * energy.limit_distance_m;
  const double drive_input = quotient(energy.drive_work_J, limit_J);
  const double stored_as_printed =
      quotient(energy.stored_integral_J_s + energy.momentum_integral_J_s, limit_J * period_s);
  const double change_J = energy.stored_end_J - energy.stored_begin_J;
  return {
      quotient(energy.resistance_impulse_N_s, friction_N * energy.undriven_s),
      quotient(energy.pull_work_J, limit_J),
      quotient(energy.friction_work_J, limit_J),
      drive_input,
      quotient(change_J, limit_J),
      quotient(energy.damping_work_J, limit_J),
      balance_residual(energy, sign, scale_J, has_load),
      has_load ? std::numeric_limits<double>::quiet_NaN() : 1.0 + drive_input - stored_as_printed,
      quotient(energy.load.force_work_J, limit_J),
      quotient(energy.load.spring_pull_work_J, limit_J),
      quotient(energy.load.damping_work_J, limit_J),
      quotient(energy.load.change_J(), limit_J)};
}

}  // namespace

PowerRatios power_ratios(const EnergyBalance& energy, double friction_N,
                         scene::SignConvention convention, double period_s) {
  return ratios(energy, friction_N, convention, period_s, 0.0, false);
}

PowerRatios power_ratios(const scene::Scene& scene, const EnergyBalance& energy) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const scene::PlantScales scales = configure::plant_scales(scene);
  return ratios(energy, scene.friction.largest_limit_N(), scene.friction.sign_convention,
                scene.drive ? 1.0 / scene.drive->frequency_Hz : none,
                scales.force_N * scales.length_m, scene.load.has_value());
}

}  // namespace sonoglide::loop
