#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "host_sim/studies/paper/figure_style.hpp"
#include "host_sim/studies/paper/figures.hpp"
#include "host_sim/studies/paper/runs.hpp"

namespace sonoglide::paper {
namespace {

struct Laws {
  std::vector<double> coulomb;
  std::vector<double> dahl;
  SimulatedRatios simulated_coulomb;
  SimulatedRatios simulated_dahl;
};

Laws both_laws() {
  scene::Scene scene = table_1();
  const double dahl = dahl_number(scene);
  const std::vector<double> velocities = sliding_velocities_m_per_s(scene);
  Laws laws;
  for (const double ratio : velocity_ratios()) {
    laws.coulomb.push_back(friction::coulomb_friction_ratio(ratio));
    laws.dahl.push_back(friction::dahl_friction_ratio(ratio, dahl));
  }
  laws.simulated_dahl = ratio_curve(scene, velocities);
  scene.friction.law = scene::laws::Coulomb{};
  laws.simulated_coulomb = ratio_curve(scene, velocities);
  return laws;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::fmax(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

std::string csv(const Laws& laws) {
  return to_csv({{"velocity_ratio", velocity_ratios()},
                 {"coulomb_closed_form", laws.coulomb},
                 {"coulomb_from_rest", laws.simulated_coulomb.friction_from_rest},
                 {"coulomb_steady", laws.simulated_coulomb.friction_steady},
                 {"dahl_closed_form", laws.dahl},
                 {"dahl_from_rest", laws.simulated_dahl.friction_from_rest},
                 {"dahl_steady", laws.simulated_dahl.friction_steady},
                 {"coulomb_dissipation_steady", laws.simulated_coulomb.dissipation_steady},
                 {"dahl_dissipation_steady", laws.simulated_dahl.dissipation_steady}});
}

output::Chart ratio_chart(const Laws& laws) {
  const std::vector<double>& x = velocity_ratios();
  const double dahl = dahl_number(table_1());
  const double furthest = x.back();
  return chart("Friction ratio at 384 N", "Vt / peak vibration velocity [-]", "friction ratio [-]",
               {line_of(friction::coulomb_friction_ratio<double>, furthest, 1),
                curve("", x, laws.simulated_coulomb.friction_steady, 1, Style::points),
                curve("", x, laws.simulated_coulomb.friction_from_rest, 1, Style::dashed),
                line_of([dahl](double ratio) { return friction::dahl_friction_ratio(ratio, dahl); },
                        furthest, 2),
                curve("", x, laws.simulated_dahl.friction_steady, 2, Style::points),
                curve("", x, laws.simulated_dahl.friction_from_rest, 2, Style::dashed),
                curve("Coulomb", {}, {}, 1, Style::marked), curve("Dahl", {}, {}, 2, Style::marked),
                curve("from rest", {}, {}, black, Style::dashed)},
               Key::lower_right, {0.0, 1.05});
}

std::vector<Claim> claims(const Laws& laws) {
  const std::size_t half = index_of(0.5);
  bool coulomb_lower = true;
  for (std::size_t i = 0; i < laws.coulomb.size(); ++i) {
    coulomb_lower = coulomb_lower && laws.simulated_coulomb.friction_steady[i] <=
                                         laws.simulated_dahl.friction_steady[i];
  }
  scene::Scene heavier = table_1();
  heavier.plant.mass_kg *= 2.0;
  heavier.friction.normal_force_N *= 2.0;
  return {
      {"The Coulomb law predicts more reduction than the Dahl law.", verdict(coulomb_lower),
       fmt::format("At a velocity ratio of 0.5: Coulomb {:.4f}, Dahl {:.4f}; so at every one.",
                   laws.simulated_coulomb.friction_steady[half],
                   laws.simulated_dahl.friction_steady[half])},
      {"With the Dahl law the reduction depends on mass, friction coefficient and contact "
       "stiffness "
       "as well.",
       ClaimStatus::holds,
       fmt::format("Through one number, Kt X/Fc = {:.4f} here, {:.4f} with twice the mass.",
                   dahl_number(table_1()), dahl_number(heavier))},
      {"The closed forms, which prescribe a sinusoidal vibration, miss what the natural mode does.",
       ClaimStatus::depends,
       fmt::format(
           "On its steady orbit it departs from them by at most {:.1e} (Coulomb) and {:.1e} "
           "(Dahl); from rest by {:.3f} and {:.3f}: the undamped free vibration "
           "is in the mean.",
           largest_difference(laws.coulomb, laws.simulated_coulomb.friction_steady),
           largest_difference(laws.dahl, laws.simulated_dahl.friction_steady),
           largest_difference(laws.coulomb, laws.simulated_coulomb.friction_from_rest),
           largest_difference(laws.dahl, laws.simulated_dahl.friction_from_rest))}};
}

}  // namespace

Figure figure_2() {
  const Laws laws = both_laws();
  return {
      2,
      "Coulomb and Dahl friction under vibration",
      "Table 1 at 384 N. Lines: closed forms; symbols: the plant on its steady orbit, mean over "
      "one carrier period; dashed: from rest, mean over the first 100 carrier periods.",
      "sonoglide sweep table_1.toml --vary velocity_ratio=0.05:1.2:24 --set run.start=steady",
      csv(laws),
      {ratio_chart(laws)},
      claims(laws)};
}

}  // namespace sonoglide::paper
