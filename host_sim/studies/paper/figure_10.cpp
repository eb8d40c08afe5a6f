#include <fmt/format.h>

#include <cmath>

#include "host_sim/studies/paper/variations.hpp"

namespace sonoglide::paper {
namespace {

/// The same scenes at the same sliding velocities, without their drive.
std::vector<Variation> without_excitation(const std::vector<Variation>& driven) {
  std::vector<Variation> undriven;
  for (const Variation& each : driven) {
    scene::Scene scene = each.scene;
    scene.drive->force_amplitude_N = 0.0;
    undriven.push_back({each.label, "un" + each.name, scene,
                        ratio_curve(scene, sliding_velocities_m_per_s(table_1()))});
  }
  return undriven;
}

double lowest_steady_friction(const std::vector<Variation>& variations) {
  double lowest = 1.0;
  for (const Variation& each : variations) {
    for (const double ratio : each.curve.friction_steady) {
      lowest = std::fmin(lowest, ratio);
    }
  }
  return lowest;
}

/// @param driven  the contact stiffness rises
Claim stiff_contact(const std::vector<Variation>& driven) {
  std::string energies;
  std::string stored;
  double before_J = 0.0;
  bool rises = true;
  for (const Variation& each : driven) {
    const Balance b = steady_balance(each.scene, 0.5);
    rises = rises && b.average_stored > before_J;
    before_J = b.average_stored;
    const double limit_N = each.scene.friction.limit_N();
    const char* separator = energies.empty() ? "" : "; ";
    energies += fmt::format("{}{:.7g} J", separator, b.average_stored);
    stored += fmt::format("{}{:.2g} J", separator,
                          0.5 * limit_N * limit_N / each.scene.friction.contact_stiffness_N_per_m);
  }
  const bool more_friction = follows(driven, 0.5, &SimulatedRatios::friction_steady, Trend::rising);
  return {
      "A stiffer contact means more friction and more energy in the system.",
      verdict(more_friction && rises),
      "Steady orbit. " + listed(driven, 0.5, &SimulatedRatios::friction_steady) +
          fmt::format("So less friction, as the next claim has it; without excitation it is the "
                      "same for all. The average energy of mass and spring is {}: the drive sets "
                      "it. What the contact itself can store, Fc^2/2Kt, falls: {}.",
                      energies, stored)};
}

std::vector<Claim> claims_on_contact_stiffness(const std::vector<Variation>& undriven,
                                               const std::vector<Variation>& driven) {
  const double lowest = lowest_steady_friction(undriven);
  return {
      {"Without excitation friction falls, the more the stiffer the contact.",
       verdict(lowest < 0.999),
       fmt::format("On the steady orbit no ratio is below {:.6f}: sliding at a constant speed "
                   "takes the full force. From rest, with F = 0, the force has to build up over "
                   "Fc/Kt of travel first, which is the shorter the stiffer the contact: the "
                   "opposite of the claim. {}",
                   lowest, listed(undriven, 0.1, &SimulatedRatios::friction_from_rest))},
      {"Without excitation the power dissipation is always below unity.",
       ClaimStatus::does_not_hold,
       listed(undriven, 0.5, &SimulatedRatios::dissipation_steady) +
           "Below it only from rest, while the force builds up."},
      stiff_contact(driven),
      trend("A stiffer contact makes friction reduction more effective.", driven, 0.5,
            &SimulatedRatios::friction_steady, Trend::falling, "Under excitation.")};
}

}  // namespace

Figure figure_10() {
  const std::vector<Variation> driven = vary(
      table_1(), {5.6e3, 56e3, 560e3}, "Kt = {:g} N/m", "driven_{:g}_N_per_m",
      [](scene::Scene& scene, double value) { scene.friction.contact_stiffness_N_per_m = value; });
  const std::vector<Variation> undriven = without_excitation(driven);
  const std::vector<output::Chart> of_undriven =
      charts(undriven, "(a) Friction ratio, no excitation",
             "(b) Power dissipation ratio, no excitation", Key::lower_right, friction_span);
  std::vector<Column> of_driven = columns(driven);
  of_driven.erase(of_driven.begin());  // the velocity ratios stand before the others already
  return {10,
          "Effect of the contact stiffness",
          conditions("Table 1, without excitation as the paper has it, and at 384 N; without "
                     "excitation the abscissa is the sliding velocity over the vibration velocity "
                     "at 384 N."),
          sweep_command("--set friction.contact_stiffness_N_per_m=560e3"),
          to_csv(joined(columns(undriven), of_driven)),
          joined(of_undriven,
                 charts(driven, "(c) Friction ratio, 384 N", "(d) Power dissipation ratio, 384 N")),
          claims_on_contact_stiffness(undriven, driven)};
}

}  // namespace sonoglide::paper
