#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "host_sim/loop/run.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/studies/paper/figure_style.hpp"
#include "host_sim/studies/paper/figures.hpp"
#include "host_sim/studies/paper/runs.hpp"

namespace sonoglide::paper {
namespace {

constexpr double loop_periods = 3.0;
constexpr double samples_per_loop = 400.0;

loop::Recording record_steady(const scene::FrictionLaw& law) {
  scene::Scene scene = steady(table_1());
  scene.friction.law = law;
  scene.run.duration_s = loop_periods * period_s(scene);
  return record(scene, 0.0, period_s(scene) / samples_per_loop);
}

/// Largest change from one sample to the next.
double largest_jump(const std::vector<double>& values) {
  double largest = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    largest = std::max(largest, std::abs(values[i] - values[i - 1]));
  }
  return largest;
}

/// On one scale for both laws.
output::Chart over_time(const char* title, const std::vector<double>& time_s,
                        const std::vector<double>& force_N, int colour) {
  return chart(title, "time [µs]", "friction force [mN]",
               {curve("", output::scaled(time_s, 1e6), output::scaled(force_N, 1e3), colour)},
               Key::above, {-22.0, 22.0});
}

struct Accuracy {
  double relative_error;  ///< of the friction ratio, 100 carrier periods from rest
  double steps_per_period;
};

/// @param reference  friction ratio
Accuracy accuracy(const scene::Scene& scene, double reference) {
  const loop::RunResult result = loop::run(scene);
  const double ratio = loop::power_ratios(scene, result.whole).friction_ratio;
  return {std::abs(ratio / reference - 1.0),
          static_cast<double>(result.solver_steps) * period_s(scene) / scene.run.duration_s};
}

double reference_ratio(const scene::Scene& scene) {
  return loop::power_ratios(scene, loop::run(scene).whole).friction_ratio;
}

Claim small_steps() {
  scene::Scene coulomb = table_1();
  coulomb.friction.law = scene::laws::Coulomb{};
  const double coulomb_ratio = reference_ratio(coulomb);
  const auto fixed_steps = [](scene::Scene scene, double reference, int steps) {
    scene.solver.method = scene::method_of<scene::solvers::Rk4>;
    scene.solver.step_s = period_s(scene) / steps;
    return accuracy(scene, reference).relative_error;
  };
  scene::Scene stopping = coulomb;
  stopping.solver.tolerance = 1e-9;
  const Accuracy at_events = accuracy(stopping, coulomb_ratio);
  return {"The signum function makes very small time steps necessary, and the runs long.",
          ClaimStatus::depends,
          fmt::format(
              "Of a method with fixed steps: with the Coulomb law 1000 Runge-Kutta steps in "
              "a carrier period err by {:.1e} of the friction ratio and 4000 by {:.1e}, with "
              "the Dahl law 1000 by {:.1e}. Not of one that ends a step where the velocity "
              "passes zero: {:.1f} steps in a period err by {:.1e}.",
              fixed_steps(coulomb, coulomb_ratio, 1000), fixed_steps(coulomb, coulomb_ratio, 4000),
              fixed_steps(table_1(), reference_ratio(table_1()), 1000), at_events.steps_per_period,
              at_events.relative_error)};
}

}  // namespace

Figure figure_3() {
  const loop::Recording coulomb = record_steady(scene::laws::Coulomb{});
  const loop::Recording dahl = record_steady(scene::laws::Dahl{});
  const std::vector<double> pulses_N = friction_forces_N(coulomb);
  const std::vector<double> wave_N = friction_forces_N(dahl);
  const double limit_N = table_1().friction.limit_N();
  const double pulse_jump = largest_jump(pulses_N) / limit_N;
  const double wave_jump = largest_jump(wave_N) / limit_N;
  return {
      3,
      "Friction force over time",
      "Table 1 at 384 N, velocity ratio 0.5, on the steady orbit from drive phase 0.",
      "sonoglide run table_1.toml --set run.start=steady --set run.duration_periods=3 --set "
      "run.record='[\"friction_force_N\"]' --set run.record_interval_s=1e-7",
      to_csv({{"time_s", dahl.time_s},
              {"coulomb_friction_force_N", pulses_N},
              {"dahl_friction_force_N", wave_N}}),
      {over_time("(a) Coulomb", coulomb.time_s, pulses_N, 1),
       over_time("(b) Dahl", dahl.time_s, wave_N, 2)},
      {{"With the Coulomb law the force is discontinuous, a train of pulses.",
        verdict(pulse_jump > 1.9),
        fmt::format("It jumps by {:.3f} of its limit from one sample to the next.", pulse_jump)},
       {"With the Dahl law it is a continuous oscillation.", verdict(wave_jump < 0.1),
        fmt::format("The largest change between samples 1/400 of a period apart is {:.4f} of the "
                    "limit.",
                    wave_jump)},
       small_steps()}};
}

}  // namespace sonoglide::paper
