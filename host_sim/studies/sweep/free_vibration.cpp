#include "host_sim/studies/sweep/free_vibration.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <cstddef>

#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::sweep {

double free_vibration_part(const scene::Scene& scene) {
  const scene::Plant& plant = scene.plant;
  const double natural_rad_per_s = plant.natural_rad_per_s();
  const double decay_per_s = 0.5 * plant.damping_N_s_per_m / plant.mass_kg;
  const bool from_a_state = !scene.controller && scene.run.start == scene::Start::given;
  if (!from_a_state || !scene.drive || !(scene.drive_force_N() > 0.0) ||
      !(natural_rad_per_s > decay_per_s)) {
    return 0.0;
  }
  const double rate_rad_per_s = scene.drive->rate_rad_per_s();
  const std::complex<double> stiffness = configure::dynamic_stiffness(plant, rate_rad_per_s);
  if (!(std::abs(stiffness) > 0.0)) {
    return 0.0;
  }
  const std::complex<double> driven_m = scene.drive_force_N() / stiffness;
  const double displacement_m = plant.initial_displacement_m - driven_m.real();
  const double velocity_m_per_s = plant.initial_velocity_m_per_s + rate_rad_per_s * driven_m.imag();
  return std::hypot(natural_rad_per_s * displacement_m, velocity_m_per_s) *
         std::exp(-decay_per_s * scene.run.window_start_s) / (rate_rad_per_s * std::abs(driven_m));
}

std::vector<std::string> start_notes(const Plan& plan) {
  constexpr std::size_t most_read = 4096;
  constexpr double told_from = 0.01;
  const std::size_t points = plan.grid().size();
  const std::size_t step = (points - 1) / most_read + 1;
  double most = 0.0;
  std::size_t where = 0;
  for (std::size_t point = 0; point < points; point += step) {
    const double part = free_vibration_part(plan.experiment(point).plant);
    if (part > most) {
      most = part;
      where = point;
    }
  }
  if (!(most > told_from)) {
    return {};
  }
  return {fmt::format(
      "The runs begin at a given state, and damping leaves the free vibration of the natural mode "
      "in the means: at {} its velocity is up to {:.3g} % of the driven one when the window "
      "begins.{}",
      plan.describe(where), 100.0 * most,
      plan.experiment(where).plant.load ? "" : " run.start = \"steady\" begins without it.")};
}

}  // namespace sonoglide::sweep
