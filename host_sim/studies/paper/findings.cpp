#include "host_sim/studies/paper/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/studies/paper/runs.hpp"

namespace sonoglide::paper {
namespace {

constexpr double balanced_ratios[] = {0.1, 0.25, 0.5, 0.75, 0.95, 1.2};

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

Balance steady_balance(const scene::Scene& scene, double velocity_ratio) {
  return balance("steady", velocity_ratio, steady(at_velocity_ratio(scene, velocity_ratio)));
}

Balance steady_balance(double velocity_ratio) {
  return steady_balance(table_1(), velocity_ratio);
}

std::vector<Balance> balances() {
  std::vector<Balance> all;
  for (const double ratio : balanced_ratios) {
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

namespace {

double steady_friction_ratio(double velocity_ratio) {
  const scene::Scene scene = steady(at_velocity_ratio(table_1(), velocity_ratio));
  return loop::power_ratios(scene, loop::run(scene).whole).friction_ratio;
}

/// From rest, the mean from a time on.
double friction_ratio_from_rest(scene::Scene scene, double duration_s, double window_start_s) {
  scene.solver.tolerance = 1e-8;
  scene.run.duration_s = duration_s;
  scene.run.window_start_s = window_start_s;
  return loop::power_ratios(scene, loop::run(scene).window).friction_ratio;
}

PrintedFault sign() {
  scene::Scene printed = table_1();
  printed.friction.sign_convention = scene::SignConvention::as_printed;
  return {"Equations (1) and (2) take V = Vt - x' with -F, equations (6) and (8) Vt + x'.",
          fmt::format("As printed friction pumps energy into the vibration, which has no steady "
                      "state: friction ratio {:.3f} after 0.2 s (mean of 1 ms), {:.3f} in the "
                      "dissipative convention.",
                      friction_ratio_from_rest(printed, 0.2, 0.199),
                      friction_ratio_from_rest(table_1(), 0.2, 0.199)),
          "Dissipative; sign_convention = \"as_printed\" on request, with a warning."};
}

/// The mean force of F = Kt V (1 - sgn(V) F/Fc), with Kt in N s/m, under a sinusoidal velocity.
double algebraic_friction_ratio(const scene::Scene& scene) {
  constexpr int samples = 20000;
  const double sliding = scene.sliding.profile.front().velocity_m_per_s;
  const double limit_N = scene.friction.limit_N();
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double velocity = sliding * (1.0 + 2.0 * std::cos(numeric::two_pi * (i + 0.5) / samples));
    const double force_N = scene.friction.contact_stiffness_N_per_m * velocity;
    sum += force_N / (limit_N + std::abs(force_N));
  }
  return sum / samples;
}

PrintedFault lost_dot() {
  return {"Equation (2) has lost the dot over the friction force.",
          fmt::format("Taken literally it is algebraic, its units do not agree, and it gives a "
                      "friction ratio of {:.4f} at a velocity ratio of 0.5: Coulomb's {:.4f}, not "
                      "Dahl's {:.4f}.",
                      algebraic_friction_ratio(table_1()), friction::coulomb_friction_ratio(0.5),
                      steady_friction_ratio(0.5)),
          "dF/dt is integrated."};
}

PrintedFault stored_energy() {
  const Balance at_half = steady_balance(0.5);
  return {"Equations (9) to (16) add the average of the stored energy, not its change.",
          fmt::format("At a velocity ratio of 0.5 on the steady orbit equation (16) gives a power "
                      "dissipation ratio of {:.1f}; friction takes {:.4f}.",
                      at_half.printed_dissipation_ratio, at_half.true_dissipation_ratio),
          "The true balance and its residual, see below; the printed value beside it."};
}

PrintedFault window() {
  const auto after = [](double time_s) {
    return friction_ratio_from_rest(table_1(), time_s, time_s - 1e-3);
  };
  return {
      "Neither initial state nor averaging window is given, and nothing is damped.",
      fmt::format("From rest a free vibration stays in the mean: friction ratio {:.4f} after 2 ms "
                  "(mean of the last one), {:.4f} after 20 ms, {:.4f} after 200 ms, {:.4f} on the "
                  "steady orbit.",
                  after(2e-3), after(20e-3), after(200e-3), steady_friction_ratio(0.5)),
      "Every figure states both, and gives a start from rest and the steady orbit."};
}

PrintedFault floor() {
  return {
      "Inertia, friction and friction-induced oscillation are said to keep the ratio from zero.",
      fmt::format("With this model nothing does: {:.4f}, {:.5f} and {:.6f} at velocity ratios of "
                  "0.1, 0.01 and 0.001.",
                  steady_friction_ratio(0.1), steady_friction_ratio(0.01),
                  steady_friction_ratio(0.001)),
      "A limit of the model: a floor needs a contact that sticks elastically, as Iwan's."};
}

PrintedFault unexcited() {
  return {"Figure 10 shows a reduction without excitation.",
          "There is none in this model but while the force builds up, see figure 10.",
          "What the model gives."};
}

}  // namespace

std::vector<PrintedFault> faults() {
  return {sign(), lost_dot(), stored_energy(), window(), floor(), unexcited()};
}

}  // namespace sonoglide::paper
