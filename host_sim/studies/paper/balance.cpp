#include "host_sim/studies/paper/balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/studies/paper/recorded_run.hpp"
#include "host_sim/studies/paper/table_1.hpp"

namespace sonoglide::paper {
namespace {

constexpr double ratios[] = {0.1, 0.25, 0.5, 0.75, 0.95, 1.2};

double largest_of(std::initializer_list<double> terms) {
  double largest = 0.0;
  for (const double term : terms) {
    largest = std::max(largest, std::abs(term));
  }
  return largest;
}

/// ∫Ks x²/2 dt over the last carrier period, by Simpson's rule.
double spring_integral_J_s(const scene::Scene& scene) {
  constexpr int steps = 1000;
  const double interval_s = period_s(scene) / steps;
  const std::vector<double> x =
      displacements_m(record(scene, scene.run.duration_s - period_s(scene), interval_s));
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double weight = i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    const double at = x[static_cast<std::size_t>(i)];
    sum += weight * at * at;
  }
  return 0.5 * scene.plant.stiffness_N_per_m * sum * interval_s / 3.0;
}

/// @param scene  its window is its last carrier period
Balance balance(const std::string& start, double velocity_ratio, const scene::Scene& scene) {
  const loop::EnergyBalance energy = loop::run(scene).window;
  const double period = period_s(scene);
  const double sliding = scene.sliding.profile.front().velocity_m_per_s;
  const double spring_J_s = spring_integral_J_s(scene);
  Balance b{};
  b.start = start;
  b.velocity_ratio = velocity_ratio;
  b.kinetic_sliding = 0.5 * scene.plant.mass_kg * sliding * sliding;
  b.undriven = scene.friction.limit_N() * sliding * period;
  b.input_undriven = b.kinetic_sliding + b.undriven;
  b.ultrasonic_input = energy.drive_work_J;
  b.input = b.input_undriven + b.ultrasonic_input;
  b.average_kinetic =
      b.kinetic_sliding +
      (energy.momentum_integral_J_s + energy.stored_integral_J_s - spring_J_s) / period;
  b.average_potential = spring_J_s / period;
  b.dissipated = energy.friction_work_J;
  b.average_stored = (energy.stored_integral_J_s + energy.momentum_integral_J_s) / period;
  b.pull = energy.pull_work_J;
  b.stored_change = energy.stored_end_J - energy.stored_begin_J;
  b.printed_dissipation_ratio = (b.undriven + b.ultrasonic_input - b.average_stored) / b.undriven;
  b.true_dissipation_ratio = b.dissipated / b.undriven;
  b.printed_residual = std::abs(b.undriven + b.ultrasonic_input - b.average_stored - b.dissipated) /
                       largest_of({b.undriven, b.ultrasonic_input, b.average_stored, b.dissipated});
  b.true_residual = std::abs(b.dissipated - b.pull - b.ultrasonic_input + b.stored_change) /
                    largest_of({b.dissipated, b.pull, b.ultrasonic_input, b.stored_change});
  return b;
}

}  // namespace

Balance steady_balance(double velocity_ratio) {
  return balance("steady", velocity_ratio, steady(at_velocity_ratio(table_1(), velocity_ratio)));
}

std::vector<Balance> balances() {
  std::vector<Balance> all;
  for (const double ratio : ratios) {
    scene::Scene scene = at_velocity_ratio(table_1(), ratio);
    scene.run.window_start_s = scene.run.duration_s - period_s(scene);
    all.push_back(balance("from_rest", ratio, scene));
    all.push_back(steady_balance(ratio));
  }
  return all;
}

std::string balance_csv(const std::vector<Balance>& balances) {
  std::string text = "start,velocity_ratio,equation,quantity,value\n";
  for (const Balance& b : balances) {
    const auto line = [&](const char* equation, const char* quantity, double value) {
      text += fmt::format("{},{:g},{},{},{:.17g}\n", b.start, b.velocity_ratio, equation, quantity,
                          value);
    };
    line("3", "Ei_J", b.input_undriven);
    line("4", "kinetic_sliding_J", b.kinetic_sliding);
    line("4", "Ef_J", b.undriven);
    line("5", "Einput_J", b.input);
    line("6", "Eku_J", b.average_kinetic);
    line("7", "Epu_J", b.average_potential);
    line("8", "Efu_J", b.dissipated);
    line("9", "left_J", b.input);
    line("9", "right_J", b.average_kinetic + b.average_potential + b.dissipated);
    line("10", "left_J", b.undriven + b.ultrasonic_input);
    line("10", "right_J", b.average_stored + b.dissipated);
    line("11", "Esu_J", b.average_stored);
    line("12", "Eiu_J", b.ultrasonic_input);
    line("13", "left", 1.0 + b.ultrasonic_input / b.undriven);
    line("13", "right", (b.average_stored + b.dissipated) / b.undriven);
    line("14", "Efu_over_Ef_by_it", b.printed_dissipation_ratio);
    line("15", "Pfu_over_Pf_by_it", b.printed_dissipation_ratio);
    line("16", "phi_iu", b.ultrasonic_input / b.undriven);
    line("16", "phi_su", b.average_stored / b.undriven);
    line("16", "phi_fu", b.printed_dissipation_ratio);
    line("printed", "relative_residual", b.printed_residual);
    line("identity", "pull_J", b.pull);
    line("identity", "Eiu_J", b.ultrasonic_input);
    line("identity", "stored_change_J", b.stored_change);
    line("identity", "Efu_J", b.dissipated);
    line("identity", "phi_fu", b.true_dissipation_ratio);
    line("identity", "relative_residual", b.true_residual);
  }
  return text;
}

}  // namespace sonoglide::paper
