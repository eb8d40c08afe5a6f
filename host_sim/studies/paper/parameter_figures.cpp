/// Figures 7 to 11: force, coefficient of friction, mass, stiffness of the contact and of the system.

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

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

namespace {

/// The sliding velocity of Table 1 under a stiffness that passes the resonant one.
struct Resonance {
  std::vector<double> parts;  ///< Ks/(m ω²)
  std::vector<double> friction;
  std::vector<double> dissipation;
};

Resonance through_resonance(const Edit& edit) {
  Resonance resonance;
  for (int i = 0; i < 80; ++i) {
    const double part = 0.025 * i + 0.0125;  // never 1, where no steady orbit is
    scene::Scene scene = table_1();
    edit(scene, part);
    const SimulatedRatios point =
        ratio_curve(scene, {table_1().sliding.profile.front().velocity_m_per_s});
    resonance.parts.push_back(part);
    resonance.friction.push_back(point.friction_steady.front());
    resonance.dissipation.push_back(point.dissipation_steady.front());
  }
  return resonance;
}

std::vector<Claim> claims(const Resonance& resonance) {
  const std::size_t soft = 1;       // 0.0375
  const std::size_t softer = 9;     // 0.2375
  const std::size_t resonant = 39;  // 0.9875
  const std::vector<double>& friction = resonance.friction;
  const std::vector<double>& dissipation = resonance.dissipation;
  return {
      {"Near resonance the vibration grows, and friction falls at a given sliding velocity.",
       verdict(friction[resonant] < 0.5 * friction[soft]),
       fmt::format("At 26.7 mm/s: {:.4f} at 0.0375 of the resonant stiffness, {:.5f} at 0.9875. At "
                   "resonance itself the undamped plant has no steady orbit: the drive puts in "
                   "more than friction can take.",
                   friction[soft], friction[resonant])},
      {"The power dissipated is high there.",
       verdict(dissipation[resonant] > 2.0 * dissipation[soft]),
       fmt::format("{:.3f} at 0.0375 of the resonant stiffness, {:.2f} at 0.9875.",
                   dissipation[soft], dissipation[resonant])},
      {"Low stiffnesses hardly change the power dissipation ratio.",
       verdict(std::abs(dissipation[softer] - dissipation[soft]) < 0.01 * dissipation[resonant]),
       fmt::format("{:.3f} at 0.0375 of the resonant stiffness and {:.3f} at 0.2375, where the "
                   "plant is controlled by its mass; little against what resonance does.",
                   dissipation[soft], dissipation[softer])},
      {"It is best to work at the natural frequency.", ClaimStatus::depends,
       "On what is wanted: the least drive force, yes; the least power, no, see above; a ratio "
       "that keeps to its target, no: next to resonance it follows every change of mass or "
       "stiffness, and a free vibration takes the longer to fade the larger the drive's is."}};
}

std::vector<output::Chart> charts(const Resonance& resonance) {
  const char* part_label = "Ks/(m ω²) [-]";
  std::vector<output::Chart> both = {
      chart("(c) Steady orbit at Vt = 26.7 mm/s", part_label, friction_label,
            {curve("", resonance.parts, resonance.friction, 1, Style::points)}),
      chart("(d) Steady orbit at Vt = 26.7 mm/s", part_label, dissipation_label,
            {curve("", resonance.parts, resonance.dissipation, 1, Style::points)}, Key::above,
            {0.5, 200.0})};
  both.back().y_axis.logarithmic = true;
  both.back().y_axis.format = "10^{%L}";
  return both;
}

}  // namespace

Figure figure_11() {
  const double omega = table_1().drive->rate_rad_per_s();
  const double resonant_N_per_m = table_1().plant.mass_kg * omega * omega;
  const Edit edit = [resonant_N_per_m](scene::Scene& scene, double part) {
    scene.plant.stiffness_N_per_m = part * resonant_N_per_m;
  };
  const std::vector<Variation> all = vary(table_1(), {0.0468, 0.5, 0.9, 0.99, 1.2},
                                          "Ks = {:g} m ω²", "stiffness_{:g}_of_resonance", edit);
  const Resonance resonance = through_resonance(edit);
  return {11,
          "Effect of the system stiffness",
          conditions("Table 1 at 384 N; 0.0468 is its own stiffness."),
          sweep_command("--set plant.stiffness_N_per_m=2.56e9"),
          to_csv(joined(columns(all),
                        {{"stiffness_of_resonance", resonance.parts},
                         {"friction_ratio_at_26.7_mm_per_s_steady", resonance.friction},
                         {"dissipation_ratio_at_26.7_mm_per_s_steady", resonance.dissipation}})),
          joined(charts(all), charts(resonance)),
          claims(resonance)};
}

}  // namespace sonoglide::paper
