#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "host_sim/loop/steady/requirement.hpp"
#include "host_sim/loop/steady/self_excitation.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/studies/paper/figures.hpp"

namespace sonoglide::paper {
namespace {

constexpr double belt_m_per_s = 0.02;

/// The paper's resonator with a slow mode, and friction that falls with the velocity: a mass on a
/// moving belt, as in the works on squeal that it cites.
scene::Scene mass_on_belt(double carrier_Hz) {
  scene::Scene scene;
  scene.plant.mass_kg = 1.0;
  scene.plant.stiffness_N_per_m = 1e4;
  scene.friction.law = scene::laws::Stribeck{2.0, 7.5};
  scene.friction.coefficient = 0.4;
  scene.friction.normal_force_N = 10.0;
  scene.sliding.profile = {{0.0, belt_m_per_s}};
  scene.drive.emplace();
  scene.drive->frequency_Hz = carrier_Hz;
  return scene;
}

double multiplier(const scene::Scene& scene, double vibration_m_per_s) {
  return steady::steady_sliding(scene, belt_m_per_s, steady::force_N(scene, vibration_m_per_s))
      .multiplier;
}

Claim stabilises() {
  const scene::Scene scene = mass_on_belt(2e3);
  const double undriven = multiplier(scene, 0.0);
  const double weak = multiplier(scene, 0.1);
  const double strong = multiplier(scene, 0.2245);
  return {
      "Tangential dither can stabilise a system that excites itself.",
      verdict(undriven > 1.0 && weak < 1.0),
      fmt::format("A mass on a belt with falling friction: in a carrier period a small deviation "
                  "is multiplied by {:.6f} undriven and by {:.6f} under a vibration of 100 mm/s. "
                  "More is not always better: under 224.5 mm/s it is {:.6f}.",
                  undriven, weak, strong)};
}

Claim same_equations() {
  constexpr double vibration_m_per_s = 0.13;
  const scene::Scene scene = mass_on_belt(2e3);
  const double force_N = steady::force_N(scene, vibration_m_per_s);
  const double ratio = steady::orbit_ratio(steady::steady_scene(scene, belt_m_per_s, force_N));
  const double mapped = steady::closed_form_ratio(scene, belt_m_per_s, vibration_m_per_s);
  const steady::SteadySliding sliding = steady::steady_sliding(scene, belt_m_per_s, force_N);
  const double rate = std::log(sliding.multiplier);
  const double mapped_rate = std::log(sliding.averaged_multiplier);
  return {
      "Quenching stick-slip by dither and reducing friction by ultrasound obey the same equations.",
      verdict(std::abs(ratio - mapped) < 1e-3 && std::abs(rate / mapped_rate - 1.0) < 0.01),
      fmt::format("The map of the friction ratio gives both at 130 mm/s: the ratio {:.5f} (the "
                  "steady motion has {:.5f}), and by its slope over the sliding velocity the decay "
                  "of {:.3e} a carrier period ({:.3e}).",
                  mapped, ratio, -mapped_rate, -rate)};
}

/// The least vibration above that of the belt at which the drive no longer quenches [m/s].
double upper_edge_m_per_s(const std::vector<steady::DriveWindow>& windows,
                          const scene::Scene& scene) {
  for (const steady::DriveWindow& each : windows) {
    if (each.fate == steady::Fate::dies_out) {
      return each.high_N / steady::force_N(scene, 1.0);
    }
  }
  return steady::undefined;
}

Claim approximate_relations() {
  std::string numbers;
  double worst = 0.0;
  for (const double carrier_Hz : {200.0, 2e3, 2e4}) {
    const scene::Scene scene = mass_on_belt(carrier_Hz);
    const double most_N = steady::force_N(scene, 0.25);
    const double found =
        upper_edge_m_per_s(steady::drive_windows(scene, belt_m_per_s, most_N), scene);
    const double averaged =
        upper_edge_m_per_s(steady::averaged_drive_windows(scene, belt_m_per_s, most_N), scene);
    worst = std::fmax(worst, std::abs(averaged / found - 1.0));
    numbers += fmt::format("{}{} ({}) at {}", numbers.empty() ? "" : ", ",
                           output::quantity(averaged, "m/s"), output::quantity(found, "m/s"),
                           output::quantity(carrier_Hz, "Hz"));
  }
  return {
      "Averaging gives approximate relations for the amplitude and the frequency that suppress "
      "the oscillation.",
      verdict(worst < 0.05),
      fmt::format("The strongest vibration of the first quenching window by averaging, and by the "
                  "steady motion: {}. Only the velocity counts as long as the natural mode, here "
                  "15.9 Hz, is slow.",
                  numbers)};
}

}  // namespace

std::vector<Claim> dither_claims() {
  return {stabilises(), same_equations(), approximate_relations()};
}

}  // namespace sonoglide::paper
