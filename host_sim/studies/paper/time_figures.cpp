/// Figures 4 and 5: the motion at 384 N and a velocity ratio of 0.5.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "firmware/numeric/turn.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/studies/paper/figure_style.hpp"
#include "host_sim/studies/paper/figures.hpp"
#include "host_sim/studies/paper/runs.hpp"

namespace sonoglide::paper {
namespace {

constexpr int periods_shown = 30;
constexpr int samples_per_period = 40;
constexpr const char* stated_conditions =
    "Table 1 at 384 N, velocity ratio 0.5. From rest: x = x' = F = 0 at the beginning; the first "
    "30 "
    "carrier periods are shown. Steady orbit: what is left of it in the end.";
constexpr const char* command =
    "sonoglide run table_1.toml --set run.duration_periods=30 --set "
    "run.record='[\"displacement_m\", \"velocity_m_per_s\", \"friction_force_N\"]' --set "
    "run.record_interval_s=4e-7";

struct Motions {
  loop::Recording from_rest;
  loop::Recording on_orbit;
};

Motions simulated_motions() {
  const auto first_periods = [](scene::Scene scene) {
    scene.run.duration_s = periods_shown * period_s(scene);
    return record(scene, 0.0, period_s(scene) / samples_per_period);
  };
  return {first_periods(table_1()), first_periods(steady(table_1()))};
}

/// Root mean square of what is no sine at the drive's frequency, over that of the sine; the mean is
/// left aside.
double part_beside_fundamental(std::vector<double> values) {
  values.pop_back();  // begins the next carrier period
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double in_phase = 0.0;
  double quadrature = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double phase = numeric::two_pi * static_cast<double>(i) / samples_per_period;
    const double value = values[i] - mean;
    in_phase += value * std::cos(phase) * 2.0 / count;
    quadrature += value * std::sin(phase) * 2.0 / count;
    square += value * value / count;
  }
  const double fundamental = 0.5 * (in_phase * in_phase + quadrature * quadrature);
  return std::sqrt(std::max(0.0, square - fundamental) / fundamental);
}

/// What is drawn: not the SI unit, of which these motions are small parts.
struct Unit {
  const char* label;
  double per_si;
};

output::Chart over_time(const char* title, const Unit& unit, const Motions& motions,
                        const std::vector<double>& from_rest, const std::vector<double>& on_orbit) {
  const auto line = [&unit](const char* label, const loop::Recording& motion,
                            const std::vector<double>& values, int colour, Style style) {
    return curve(label, output::scaled(motion.time_s, 1e6), output::scaled(values, unit.per_si),
                 colour, style);
  };
  return chart(title, "time [µs]", unit.label,
               {line("from rest", motions.from_rest, from_rest, 1, Style::solid),
                line("steady orbit", motions.on_orbit, on_orbit, 2, Style::dashed)});
}

Claim not_sinusoidal(const char* quantity, const std::vector<double>& from_rest,
                     const std::vector<double>& on_orbit) {
  return {
      fmt::format("The {} is not sinusoidal although the drive is.", quantity),
      ClaimStatus::depends,
      fmt::format(
          "From rest, what is not at the drive's frequency has {:.1f} % of the rms value of "
          "what is: the free vibration of an undamped plant. On the steady orbit that is "
          "{:.2g} %: what friction adds cannot be seen.",
          100.0 * part_beside_fundamental(from_rest), 100.0 * part_beside_fundamental(on_orbit))};
}

Claim within_limit(const std::vector<double>& forces_N, double limit_N) {
  const double largest_N = *std::max_element(forces_N.begin(), forces_N.end());
  return {"The force stays within its limit (the paper does not say so; a solver may break it).",
          verdict(largest_N <= limit_N),
          fmt::format("Largest {:.6f} N, limit {:.6f} N.", largest_N, limit_N)};
}

Claim dissipates(const std::vector<double>& steady_powers_W, double limit_N) {
  const scene::Scene scene = steady(table_1());
  const loop::PowerRatios ratios = loop::power_ratios(scene, loop::run(scene).whole);
  const double undriven_W = limit_N * scene.sliding.profile.front().velocity_m_per_s;
  return {"What (b) shows is the power that friction dissipates.", ClaimStatus::depends,
          fmt::format(
              "In the mean, yes. A Dahl contact is a spring as well: for part of each period it "
              "gives power back, at most {:.2g} mW on the steady orbit. In the mean of that "
              "it takes {:.4f} of the {:.4f} mW that it would take undriven.",
              -1e3 * *std::min_element(steady_powers_W.begin(), steady_powers_W.end()),
              ratios.dissipation_ratio, 1e3 * undriven_W)};
}

}  // namespace

Figure figure_4() {
  const Motions motions = simulated_motions();
  const std::vector<double> displacement = displacements_m(motions.from_rest);
  const std::vector<double> velocity = velocities_m_per_s(motions.from_rest);
  const std::vector<double> steady_displacement = displacements_m(motions.on_orbit);
  const std::vector<double> steady_velocity = velocities_m_per_s(motions.on_orbit);
  return {4,
          "Displacement and velocity over time",
          stated_conditions,
          command,
          to_csv({{"time_s", motions.from_rest.time_s},
                  {"displacement_from_rest_m", displacement},
                  {"velocity_from_rest_m_per_s", velocity},
                  {"displacement_steady_m", steady_displacement},
                  {"velocity_steady_m_per_s", steady_velocity}}),
          {over_time("(a) Displacement", {"displacement [µm]", 1e6}, motions, displacement,
                     steady_displacement),
           over_time("(b) Velocity", {"vibration velocity [mm/s]", 1e3}, motions, velocity,
                     steady_velocity)},
          {not_sinusoidal("displacement", displacement, steady_displacement),
           not_sinusoidal("velocity", velocity, steady_velocity)}};
}

Figure figure_5() {
  const Motions motions = simulated_motions();
  const std::vector<double> force = friction_forces_N(motions.from_rest);
  const std::vector<double> power = dissipated_powers_W(motions.from_rest);
  const std::vector<double> steady_force = friction_forces_N(motions.on_orbit);
  const std::vector<double> steady_power = dissipated_powers_W(motions.on_orbit);
  const double limit_N = table_1().friction.limit_N();
  return {
      5,
      "Friction force and dissipated power over time",
      stated_conditions,
      command,
      to_csv({{"time_s", motions.from_rest.time_s},
              {"friction_force_from_rest_N", force},
              {"dissipated_power_from_rest_W", power},
              {"friction_force_steady_N", steady_force},
              {"dissipated_power_steady_W", steady_power}}),
      {over_time("(a) Friction force", {"friction force [mN]", 1e3}, motions, force, steady_force),
       over_time("(b) Dissipated power", {"F (Vt + x') [mW]", 1e3}, motions, power, steady_power)},
      {within_limit(force, limit_N), dissipates(steady_power, limit_N)}};
}

}  // namespace sonoglide::paper
