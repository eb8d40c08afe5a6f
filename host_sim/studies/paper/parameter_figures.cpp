/// Figures 7 to 9: force, coefficient of friction and mass.

#include <fmt/format.h>

#include "host_sim/studies/paper/variations.hpp"

namespace sonoglide::paper {
namespace {

/// Of the spring, by the paper's own terms.
Claim spring_energy() {
  const Balance b = steady_balance(0.5);
  return {
      "The potential energy of the spring is much smaller than the input energy.",
      verdict(b.average_potential < 0.1 * b.ultrasonic_input),
      fmt::format("Table 1 at a velocity ratio of 0.5, one carrier period on the steady orbit: "
                  "the spring holds {:.3g} J on average, equation (7); the drive puts in {:.3g} "
                  "J, equation (12). That is {:.0f} times as much, and {:.0f} times the left "
                  "side of (10), {:.3g} J, that the slide puts in as well. Only the kinetic "
                  "energy of the sliding in equation (5), {:.3g} J, which no period brings in, "
                  "is larger.",
                  b.average_potential, b.ultrasonic_input, b.average_potential / b.ultrasonic_input,
                  b.average_potential / (b.undriven + b.ultrasonic_input),
                  b.undriven + b.ultrasonic_input, b.kinetic_sliding)};
}

}  // namespace

Figure figure_7() {
  const std::vector<Variation> all =
      vary(table_1(), {192.0, 384.0, 960.0, 1920.0}, "{:g} N", "force_{:g}_N",
           [](scene::Scene& scene, double force_N) { scene.drive->force_amplitude_N = force_N; });
  const double from_rest = all[1].curve.dissipation_from_rest[index_of(1.1)];
  return {
      7,
      "Effect of the control force",
      conditions("Table 1."),
      sweep_command("--set drive.force_amplitude_N=960"),
      to_csv(columns(all)),
      charts(all),
      {trend("More control force lowers the friction ratio.", all, 0.5,
             &SimulatedRatios::friction_steady, Trend::falling,
             "Even at one velocity ratio: the vibration covers more presliding distances."),
       trend("At low velocity ratios more control force dissipates more.", all, 0.1,
             &SimulatedRatios::dissipation_steady, Trend::rising, ""),
       {"At and above a velocity ratio of 1 vibration has no effect.", ClaimStatus::depends,
        fmt::format("On the steady orbit it has none. From rest the free vibration still makes "
                    "the contact reverse: power dissipation ratio {:.4f} at 384 N and a velocity "
                    "ratio of 1.1.",
                    from_rest)}}};
}

Figure figure_8() {
  const std::vector<Variation> all =
      vary(table_1(), {0.05, 0.1, 0.2, 0.4}, "coefficient {:g}", "coefficient_{:g}",
           [](scene::Scene& scene, double value) { scene.friction.coefficient = value; });
  return {8,
          "Effect of the coefficient of friction",
          conditions("Table 1 at 384 N."),
          sweep_command("--set friction.coefficient=0.2"),
          to_csv(columns(all)),
          charts(all),
          {trend("A higher coefficient makes the reduction less effective.", all, 0.5,
                 &SimulatedRatios::friction_steady, Trend::rising, ""),
           trend("The power dissipation ratio falls as the coefficient rises.", all, 0.1,
                 &SimulatedRatios::dissipation_steady, Trend::falling,
                 "The reason is the presliding distance Fc/Kt, which grows, and not what the paper "
                 "gives: its stored power is an average energy, no power.")}};
}

Figure figure_9() {
  const std::vector<Variation> all = vary(table_1(), {0.02, 0.04, 0.1, 0.2}, "{:g} kg",
                                          "mass_{:g}_kg", [](scene::Scene& scene, double mass_kg) {
                                            scene.friction.normal_force_N *=
                                                mass_kg / scene.plant.mass_kg;
                                            scene.plant.mass_kg = mass_kg;
                                          });
  std::vector<output::Chart> of_all = charts(all);
  of_all[1].y_axis.span = {0.0, 2.5};  // room for the key
  return {9,
          "Effect of the mass",
          conditions("Table 1 at 384 N, the normal force being the weight."),
          sweep_command("--set plant.mass_kg=0.04"),
          to_csv(columns(all)),
          of_all,
          {trend("More mass makes the reduction less effective; the curve flattens.", all, 0.5,
                 &SimulatedRatios::friction_steady, Trend::rising,
                 "At one velocity ratio there is a bound to that, the limit of a soft contact."),
           trend("The power dissipation ratio falls as the mass rises.", all, 0.1,
                 &SimulatedRatios::dissipation_steady, Trend::falling, ""),
           spring_energy()}};
}

}  // namespace sonoglide::paper
