#include "host_sim/studies/paper/experiments.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/normal_vibration_ratio.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/studies/paper/contact_laws.hpp"
#include "host_sim/studies/paper/runs.hpp"

namespace sonoglide::paper {
namespace {

constexpr double dong_frequency_Hz = 22e3;
constexpr Interval amplitudes_m = {0.5e-6, 5e-6};
constexpr Interval coefficients = {0.1, 0.8};
constexpr double poisson_number = 0.3;
/// R. D. Mindlin, Journal of Applied Mechanics 16 (1949) 259-268.
constexpr double normal_by_tangential = (2.0 - poisson_number) / (2.0 - 2.0 * poisson_number);

double critical_velocity_m_per_s(double amplitude_m, double coefficient) {
  return coefficient * normal_by_tangential * numeric::two_pi * dong_frequency_Hz * amplitude_m;
}

/// Of a vibration as large as the indentation.
double largest_reduction(double velocity_m_per_s, double critical_m_per_s) {
  return 1.0 - friction::normal_vibration_ratio(1.0, velocity_m_per_s / critical_m_per_s);
}

}  // namespace

Interval dong_critical_velocities_m_per_s() {
  return {critical_velocity_m_per_s(amplitudes_m.least, coefficients.least),
          critical_velocity_m_per_s(amplitudes_m.most, coefficients.most)};
}

Interval dong_normal(double velocity_m_per_s) {
  return {0.0, largest_reduction(velocity_m_per_s, dong_critical_velocities_m_per_s().most)};
}

NormalContact dong_contact() {
  const auto [slow, fast] = dong_velocities_m_per_s;
  const auto [at_slow, at_fast] = dong_reductions;
  // The quotient of the two reductions rises with the critical velocity, from 0 to 1.
  double low = fast;
  double high = 1e6 * fast;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    const double quotient = largest_reduction(fast, middle) / largest_reduction(slow, middle);
    (quotient < at_fast / at_slow ? low : high) = middle;
  }
  return {low, at_slow / largest_reduction(slow, low)};
}

namespace {

constexpr Interval everything = {1.0, 1.0};

scene::Scene luo() {
  return scene_file::read_text(luo_text(), "luo_2024.toml");
}

/// A static friction of twice the sliding one.
scene::Scene luo_with_bristles(double velocity_m_per_s, double dahl_number,
                               double stribeck_velocity_m_per_s) {
  scene::Scene scene = luo();
  scene.friction.law =
      scene::laws::LuGre{2.0 * scene.friction.coefficient, stribeck_velocity_m_per_s, 0.0, 0.0};
  scene.friction.contact_stiffness_N_per_m *= dahl_number;
  scene.sliding.profile = {{0.0, velocity_m_per_s}};
  return scene;
}

/// Begun where it settles: a contact that is mostly stuck takes long.
scene::Scene luo_with_spring(double velocity_m_per_s, double dahl_number) {
  scene::Scene scene = luo();
  scene.plant.initial_displacement_m = 0.0;
  scene.friction.law = scene::laws::Iwan{};
  scene.friction.contact_stiffness_N_per_m *= dahl_number;
  scene.sliding.profile = {{0.0, velocity_m_per_s}};
  scene.run.start = scene::Start::steady;
  return scene;
}

}  // namespace

double luo_peak_m_per_s() {
  return peak_vibration_m_per_s(luo());
}

std::string luo_text() {
  return R"(# L. Luo and others, Scientific Reports 14 (2024) 25847: a slider of 1.1 kg under a longitudinal
# vibration of 0.35 um at 26 kHz, pulled at 0.1 mm/s. Measured reduction about 85 %.
# Not published, and chosen: the spring, so weak that it hardly matters, the coefficient, and a contact
# whose presliding distance is the amplitude. The drive is what moves that mass so.
[plant]
mass_kg = 1.1
stiffness_N_per_m = 1e9
initial_displacement_m = -0.35e-6

[friction]
law = "dahl"
coefficient = 0.1
contact_stiffness_N_per_m = 3.083142857142857e6

[sliding]
velocity_m_per_s = 1e-4

[drive]
frequency_Hz = 26e3
force_amplitude_N = 9924.652965710067

[run]
duration_periods = 200
window_start_periods = 100
)";
}

Interval luo_coulomb(double velocity_m_per_s) {
  const double reduction =
      1.0 - friction::coulomb_friction_ratio(velocity_m_per_s / luo_peak_m_per_s());
  return {reduction, reduction};
}

Interval luo_dahl(double velocity_m_per_s) {
  constexpr double softest = 1e-4;
  const double ratio =
      friction::dahl_friction_ratio(velocity_m_per_s / luo_peak_m_per_s(), softest);
  return {1.0 - ratio, luo_coulomb(velocity_m_per_s).most};
}

Interval luo_lugre(double velocity_m_per_s) {
  if (velocity_m_per_s == 0.0) {
    return everything;
  }
  constexpr double dahl_numbers[] = {0.1, 1.0, 10.0};
  constexpr double stribeck_velocities_m_per_s[] = {1e-3, 1e-2, 1e-1};
  std::vector<scene::Scene> scenes;
  for (const double dahl_number : dahl_numbers) {
    for (const double stribeck_velocity : stribeck_velocities_m_per_s) {
      scenes.push_back(luo_with_bristles(velocity_m_per_s, dahl_number, stribeck_velocity));
    }
  }
  std::vector<double> reductions(scenes.size());
  tbb::parallel_for(std::size_t{0}, scenes.size(),
                    [&](std::size_t i) { reductions[i] = 1.0 - vibration_ratio(scenes[i]); });
  // Without a static friction above the sliding one the law is Dahl's.
  const double r = velocity_m_per_s / luo_peak_m_per_s();
  Interval range = {1.0 - friction::dahl_friction_ratio(r, dahl_numbers[0]),
                    1.0 - friction::dahl_friction_ratio(r, dahl_numbers[2])};
  for (const double reduction : reductions) {
    range = joined(range, {reduction, reduction});
  }
  return range;
}

double elastic_stick_reduction(double dahl_number) {
  return std::min(dahl_number, 1.0);
}

Interval luo_iwan(double velocity_m_per_s) {
  constexpr double softest = 0.1;
  constexpr double stiffest = 10.0;
  if (velocity_m_per_s == 0.0) {
    return {elastic_stick_reduction(softest), elastic_stick_reduction(stiffest)};
  }
  const auto reduction = [velocity_m_per_s](double dahl_number) {
    return 1.0 - vibration_ratio(luo_with_spring(velocity_m_per_s, dahl_number));
  };
  return {reduction(softest), reduction(stiffest)};
}

Interval luo_stribeck(double velocity_m_per_s) {
  const double r = velocity_m_per_s / luo_peak_m_per_s();
  Interval range = luo_coulomb(velocity_m_per_s);
  for (const double drop : {0.1, 0.2, 0.3, 0.4, 0.5}) {
    for (const double vibration : {0.1, 0.2, 0.4, 0.6, 0.8, 1.0}) {
      const double reduction = 1.0 - stribeck_vibration_ratio(r, {drop, vibration});
      range = joined(range, {reduction, reduction});
    }
  }
  return range;
}

}  // namespace sonoglide::paper
