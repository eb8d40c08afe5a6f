#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "firmware/friction/transverse_vibration_ratio.hpp"
#include "host_sim/loop/plant/steady_orbit.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/studies/paper/contact_laws.hpp"
#include "host_sim/studies/paper/experiments.hpp"
#include "host_sim/studies/paper/figure_style.hpp"
#include "host_sim/studies/paper/figures.hpp"
#include "host_sim/studies/paper/runs.hpp"

namespace sonoglide::paper {
namespace {

/// A law over velocity_ratios().
struct LawCurve {
  const ContactLaw& law;
  std::vector<double> simulated;
  std::vector<double> closed_form;  ///< empty where none is known
};

std::vector<double> over_velocity_ratio(const std::function<double(double)>& map) {
  std::vector<double> values;
  values.reserve(velocity_ratios().size());
  for (const double ratio : velocity_ratios()) {
    values.push_back(map(ratio));
  }
  return values;
}

std::vector<LawCurve> law_curves() {
  std::vector<LawCurve> curves;
  for (const ContactLaw& law : contact_laws()) {
    curves.push_back({law, simulated_ratios(law), {}});
    if (law.closed_form) {
      curves.back().closed_form = over_velocity_ratio(law.closed_form);
    }
  }
  return curves;
}

std::string csv(const std::vector<LawCurve>& laws, const SlowSliding& slow) {
  std::vector<Column> all = {{"velocity_ratio", velocity_ratios()}};
  for (const LawCurve& each : laws) {
    all.push_back({each.law.column + "_simulated", each.simulated});
    if (each.law.closed_form) {
      all.push_back({each.law.column + "_closed_form", each.closed_form});
    }
  }
  all.push_back({"transverse_closed_form",
                 over_velocity_ratio(friction::transverse_vibration_ratio<double>)});
  for (Column& column : columns(slow)) {
    all.push_back(std::move(column));
  }
  return to_csv(all);
}

output::Chart laws_chart(const std::vector<LawCurve>& laws) {
  const double furthest = velocity_ratios().back();
  std::vector<output::Curve> curves;
  int colour = black;
  for (const LawCurve& each : laws) {
    ++colour;
    const ContactLaw& law = each.law;
    if (law.closed_form) {
      curves.push_back(line_of(law.closed_form, furthest, colour));
      curves.push_back(curve("", velocity_ratios(), each.simulated, colour, Style::points));
      curves.push_back(curve(law.name, {}, {}, colour, Style::marked));
    } else {
      curves.push_back(curve(law.name, velocity_ratios(), each.simulated, colour, Style::marked));
    }
  }
  curves.push_back(
      line_of(friction::transverse_vibration_ratio<double>, furthest, ++colour, "transverse"));
  return chart("(a) Laws of friction at Table 1, 384 N", "Vt / peak vibration velocity [-]",
               "friction with / without vibration [-]", std::move(curves), Key::upper_left,
               {0.0, 2.6});
}

/// The largest difference between simulation and closed form, but for the velocity ratio of 1, at
/// which Coulomb's form ends vertically.
double largest_difference(const LawCurve& curve) {
  double largest = 0.0;
  for (std::size_t i = 0; i < curve.closed_form.size(); ++i) {
    if (i != index_of(1.0)) {
      largest = std::fmax(largest, std::abs(curve.simulated[i] - curve.closed_form[i]));
    }
  }
  return largest;
}

/// "Coulomb 0.3333, Dahl 0.6749" at one velocity ratio.
std::string listed(const std::vector<LawCurve>& laws, double velocity_ratio) {
  std::string text;
  for (const LawCurve& each : laws) {
    text += fmt::format("{} {:.4f}, ", each.law.name, each.simulated[index_of(velocity_ratio)]);
  }
  return text + fmt::format("under transverse vibration {:.4f}",
                            friction::transverse_vibration_ratio(velocity_ratio));
}

Claim better_than_closed_forms(const std::vector<LawCurve>& laws) {
  std::string differences;
  for (const LawCurve& each : laws) {
    if (each.law.closed_form) {
      differences += fmt::format("{}{} {:.1e}", differences.empty() ? "" : ", ", each.law.name,
                                 largest_difference(each));
    }
  }
  return {"The system model describes the measured points better than the Coulomb and Dahl models.",
          ClaimStatus::depends,
          fmt::format("The points are those of Storck and others (2002); they are in no source at "
                      "hand, and nothing here is claimed of them. Once the start has faded the "
                      "system model and the closed form of its law are one; largest differences in "
                      "friction ratio below and above a velocity ratio of 1: {}. What else the "
                      "system model shows is the free vibration "
                      "of its start, see figure 2.",
                      differences)};
}

Claim law_matters(const std::vector<LawCurve>& laws) {
  return {"The Dahl law is a more complete description than Coulomb's.", ClaimStatus::depends,
          fmt::format("Laws differ more than the model from its own closed form: at a velocity "
                      "ratio of 0.5 {}; at 0.1 {}. Which of them is right only a "
                      "measurement of the same contact can say.",
                      listed(laws, 0.5), listed(laws, 0.1))};
}

Claim higher_at_low_speed() {
  constexpr double speed_m_per_s = luo_slow_m_per_s;
  const double left = 100.0 * (1.0 - luo_dahl(speed_m_per_s).least);
  const double measured = 100.0 * (1.0 - luo_slow_reduction);
  return {"At low velocity ratios measured friction is higher than what the model gives.",
          verdict(left < measured),
          fmt::format("Of other measurements too: Luo and others (2024) find about {:.0f} % of the "
                      "friction left at 0.1 mm/s, a velocity ratio of {:.4f}. Dahl leaves at most "
                      "{:.2f} % there, whatever the contact stiffness, LuGre at most {:.2f} %, "
                      "Stribeck at most {:.2f} %: a contact that goes to and fro creeps along in "
                      "them under any force. Iwan's sticks elastically and leaves {:.0f} % with "
                      "Kt X/Fc = 0.1, {:.1f} % with 10.",
                      measured, speed_m_per_s / luo_peak_m_per_s(), left,
                      100.0 * (1.0 - luo_lugre(speed_m_per_s).least),
                      100.0 * (1.0 - luo_stribeck(speed_m_per_s).least),
                      100.0 * (1.0 - luo_iwan(speed_m_per_s).least),
                      100.0 * (1.0 - luo_iwan(speed_m_per_s).most))};
}

Claim floor(const std::vector<LawCurve>& laws) {
  return {
      "Coulomb and Dahl predict that friction can vanish, the system model that it cannot.",
      ClaimStatus::does_not_hold,
      fmt::format("At a velocity ratio of 0.05 the system gives {:.4f} with the Dahl law, and in "
                  "proportion below. An elastic stick would leave 1 - Kt X/Fc at vanishing "
                  "speed: the reductions of 76 % at rest and 85 % at 0.1 mm/s are those of "
                  "Kt X/Fc = 0.76 and 0.85. The contact stiffness is not published, so that "
                  "this is no test.",
                  laws[1].simulated[index_of(0.05)])};
}

Claim normal_vibration() {
  const Interval critical = dong_critical_velocities_m_per_s();
  const NormalContact contact = dong_contact();
  return {"Vibration normal to the surface reduces friction as well, by 60 % at a seat belt.",
          ClaimStatus::depends,
          fmt::format("Not in the paper's model, which vibrates along the sliding alone and so "
                      "gives 0 %. The closed form for a contact with springs can say it, and that "
                      "the gain falls with the speed, as Dong and Dapino (2015) find, 62 % at 20.3 "
                      "mm/s and 29 % at 87 mm/s. Both follow from a critical velocity of {:.0f} "
                      "mm/s and an amplitude of {:.2f} of the indentation, which the contact "
                      "allows ({:.0f} to {:.0f} mm/s, at most 1). Two unknown numbers against two "
                      "measured ones are no test. The seat belt would need an amplitude of at "
                      "least 0.6; its speed is not given.",
                      1e3 * contact.critical_velocity_m_per_s, contact.amplitude_ratio,
                      1e3 * critical.least, 1e3 * critical.most)};
}

/// Friction at 0.1 mm/s over that at Table 1's 26.7 mm/s, without vibration.
double static_over_kinetic(std::string_view column) {
  const auto law = std::find_if(contact_laws().begin(), contact_laws().end(),
                                [&](const ContactLaw& each) { return each.column == column; });
  scene::Scene scene = scene_file::read_text(law->scene_text(), law->scene_file());
  scene.drive->force_amplitude_N = 0.0;
  // A slide on falling friction repels, undamped as the plant is.
  const auto mean_N = [&](double sliding_m_per_s) {
    scene.sliding.profile = {{0.0, sliding_m_per_s}};
    const loop::EnergyBalance energy =
        loop::find_orbit(scene, std::numeric_limits<std::uint64_t>::max()).energy;
    return energy.friction_impulse_N_s / energy.duration_s;
  };
  constexpr double slow_m_per_s = 1e-4;
  return mean_N(slow_m_per_s) / mean_N(table_1().sliding.profile.front().velocity_m_per_s);
}

Claim static_friction() {
  constexpr double rounding = 1e-9;
  const double iwan = static_over_kinetic("iwan");
  return {
      "A model like Iwan's, a spring before a friction element, cannot tell static from kinetic "
      "friction.",
      verdict(std::abs(iwan - 1.0) < rounding),
      fmt::format("Without vibration the Iwan contact takes {:.6f} times as much at 0.1 mm/s as "
                  "at 26.7 mm/s, whatever its springs, and the Dahl contact of the paper {:.6f} "
                  "times: it cannot either. The LuGre contact here, with a static friction half "
                  "as large again, takes {:.3f} times as much.",
                  iwan, static_over_kinetic("dahl"), static_over_kinetic("lugre"))};
}

Claim printed_solver() {
  const auto ratio = [](const scene::Scene& scene) {
    return loop::power_ratios(scene, loop::run(scene).whole).friction_ratio;
  };
  const double printed = ratio(scene_file::read_text(table_2_text(), "table_2.toml"));
  const double error = std::abs(printed / ratio(table_1()) - 1.0);
  return {
      "Table 2's solver, 1000 Runge-Kutta steps in a carrier period, is accurate enough.",
      verdict(error < 1e-6),
      fmt::format("The friction ratio of table_2.toml has a relative error of {:.1e}. The paper "
                  "does not say so.",
                  error)};
}

}  // namespace

Figure figure_12() {
  const std::vector<LawCurve> laws = law_curves();
  const SlowSliding slow = slow_sliding();
  const std::vector<MeasurementComparison> comparisons = compare_measurements();
  Figure figure{
      12,
      "The laws against each other and against measurements",
      "(a) Table 1 at 384 N, begun on the vibration: symbols are means over the second 100 carrier "
      "periods, lines closed forms, each over what the contact takes without vibration at the same "
      "speed; transverse: Coulomb friction under vibration across the sliding. What no source "
      "gives "
      "of LuGre and Stribeck contacts is chosen, see their scenes. (b), (c) Luo and others (2024): "
      "longitudinal vibration of 0.35 µm at 26 kHz; (b) all that the laws say over what is not "
      "published, (c) over the contact stiffness. (d) The closed form of normal vibration at 22 "
      "kHz, "
      "Vc the speed from which nothing is gained, and Dong and Dapino (2015). Nothing is fitted, "
      "and "
      "no measurement of transverse vibration is at hand. measurements.csv has every law beside "
      "every measurement, and what each range goes over.",
      "sonoglide sweep table_1_lugre.toml --vary velocity_ratio=0.05:1.2:24, or the same of "
      "another "
      "law; sonoglide sweep luo_2024.toml --vary sliding.velocity_m_per_s=5e-5:1e-3:20 --vary "
      "friction.contact_stiffness_N_per_m=3e5:3e7:3:log",
      csv(laws, slow),
      {laws_chart(laws), slow_sliding_chart(slow), contact_stiffness_chart(),
       normal_vibration_chart()},
      {better_than_closed_forms(laws), law_matters(laws), higher_at_low_speed(), floor(laws),
       normal_vibration(), static_friction(), printed_solver()},
      {measurement_table(comparisons)},
      {{"measurements.csv", measurements_csv(comparisons)}, {"luo_2024.toml", luo_text()}}};
  for (const ContactLaw& law : contact_laws()) {
    figure.files.push_back({law.scene_file(), law.scene_text()});
  }
  return figure;
}

}  // namespace sonoglide::paper
