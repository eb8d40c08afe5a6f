#include "host_sim/studies/paper/faults.hpp"

#include <fmt/format.h>

#include <cmath>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/studies/paper/balance.hpp"
#include "host_sim/studies/paper/table_1.hpp"

namespace sonoglide::paper {
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

Fault sign() {
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

Fault lost_dot() {
  return {"Equation (2) has lost the dot over the friction force.",
          fmt::format("Taken literally it is algebraic, its units do not agree, and it gives a "
                      "friction ratio of {:.4f} at a velocity ratio of 0.5: Coulomb's {:.4f}, not "
                      "Dahl's {:.4f}.",
                      algebraic_friction_ratio(table_1()), friction::coulomb_friction_ratio(0.5),
                      steady_friction_ratio(0.5)),
          "dF/dt is integrated."};
}

Fault stored_energy() {
  const Balance at_half = steady_balance(0.5);
  return {"Equations (9) to (16) add the average of the stored energy, not its change.",
          fmt::format("At a velocity ratio of 0.5 on the steady orbit equation (16) gives a power "
                      "dissipation ratio of {:.1f}; friction takes {:.4f}.",
                      at_half.printed_dissipation_ratio, at_half.true_dissipation_ratio),
          "The true balance and its residual, see below; the printed value beside it."};
}

Fault window() {
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

Fault floor() {
  return {
      "Inertia, friction and friction-induced oscillation are said to keep the ratio from zero.",
      fmt::format("With this model nothing does: {:.4f}, {:.5f} and {:.6f} at velocity ratios of "
                  "0.1, 0.01 and 0.001.",
                  steady_friction_ratio(0.1), steady_friction_ratio(0.01),
                  steady_friction_ratio(0.001)),
      "A limit of the model: a floor needs a contact that sticks elastically, as Iwan's."};
}

Fault unexcited() {
  return {"Figure 10 shows a reduction without excitation.",
          "There is none in this model but while the force builds up, see figure 10.",
          "What the model gives."};
}

}  // namespace

std::vector<Fault> faults() {
  return {sign(), lost_dot(), stored_energy(), window(), floor(), unexcited()};
}

}  // namespace sonoglide::paper
