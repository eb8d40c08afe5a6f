#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "host_sim/studies/paper/variations.hpp"

namespace sonoglide::paper {
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
