#include "host_sim/studies/identify/friction/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware/numeric/turn.hpp"

namespace sonoglide::identify::friction {
namespace {

constexpr double assumed_coefficient = 0.1;
constexpr double assumed_limit_N = 0.01962;
constexpr double assumed_frequency_Hz = 60e3;
/// Ks/(m w²) of Table 1 of the paper.
constexpr double assumed_tuning = 0.0467904;

/// What the scene is made of, measured or assumed.
struct Numbers {
  double frequency_Hz;
  double limit_N;
  double normal_force_N;
  double mass_kg;
  double stiffness_N_per_m;
  double damping_N_s_per_m;
  double force_amplitude_N;
  /// Of what is known per amplitude, or per vibration velocity where the carrier is not known.
  double per_m;
};

Numbers numbers(const Comparison& comparison, const Reading& row) {
  Numbers all{};
  const bool has_frequency = row.frequency_Hz > 0.0;
  all.frequency_Hz = has_frequency ? row.frequency_Hz : assumed_frequency_Hz;
  const LawFit& best = comparison.best();
  all.limit_N =
      comparison.readings.are_forces ? std::exp(best.logs(best.logs.size() - 1)) : assumed_limit_N;
  all.normal_force_N = all.limit_N / assumed_coefficient;
  const double omega = numeric::two_pi * all.frequency_Hz;
  // So heavy that the contact's forces do not bend the vibration.
  constexpr double least_kg = 0.02;
  constexpr double heavier = 1000.0;
  all.mass_kg = std::max(least_kg, heavier * all.normal_force_N / (omega * row.vibration_m_per_s));
  const double inertia = all.mass_kg * omega * omega;
  all.stiffness_N_per_m = assumed_tuning * inertia;
  // A tenth of critical damping: the steady vibration is found at once.
  all.damping_N_s_per_m = 0.2 * std::sqrt(all.stiffness_N_per_m * all.mass_kg);
  all.force_amplitude_N =
      row.vibration_m_per_s *
      std::hypot((inertia - all.stiffness_N_per_m) / omega, all.damping_N_s_per_m);
  all.per_m = has_frequency ? 1.0 : omega;
  return all;
}

std::string stribeck_keys(double depth, double speed) {
  // At 1 the least friction is 0, which rounding must not pass.
  const double drop = std::min(depth, 0.9999);
  return fmt::format("fall_s_per_m = {:.9g}\nrise_s3_per_m3 = {:.9g}\n",
                     assumed_coefficient * 1.5 * drop / speed,
                     assumed_coefficient * 0.5 * drop / (speed * speed * speed));
}

std::string normal_keys(double normal_per_m, double share, const Numbers& all) {
  const double normal_N_per_m = normal_per_m * all.per_m * all.normal_force_N;
  return fmt::format(
      "normal_contact_stiffness_N_per_m = {:.9g}   # kz/N0 times N0\n"
      "contact_stiffness_N_per_m = {:.9g}   # kx, so that mu kz/kx is the fitted one\n",
      normal_N_per_m, assumed_coefficient * normal_N_per_m / share);
}

/// The keys that the law has of its own.
std::string law_keys(const LawFit& fit, const Numbers& all) {
  const std::string& law = fit.law.law;
  const auto value = [&](Eigen::Index i) { return std::exp(fit.logs(i)); };
  if (law == "stribeck") {
    return stribeck_keys(value(0), value(1));
  }
  if (law == "normal_coulomb") {
    return normal_keys(value(0), value(1), all);
  }
  if (law != "dahl" && law != "iwan" && law != "lugre") {
    return {};
  }
  std::string keys = fmt::format("contact_stiffness_N_per_m = {:.9g}   # Kt/Fc times Fc\n",
                                 value(0) * all.per_m * all.limit_N);
  if (law == "iwan") {
    keys += fmt::format("elements = {}\n", fit.law.elements);
  }
  if (law == "lugre") {
    keys += fmt::format(
        "static_coefficient = {:.9g}\nstribeck_velocity_m_per_s = {:.9g}\n"
        "viscous_friction_N_s_per_m = {:.9g}\n"
        "bristle_damping_N_s_per_m = 0.0   # mean friction does not determine it\n",
        assumed_coefficient * (1.0 + value(1)), value(2), value(3) * all.limit_N);
  }
  return keys;
}

/// The middle reading of those with vibration.
const Reading& scene_reading(const Readings& readings) {
  std::vector<const Reading*> vibrating;
  for (const Reading& row : readings.rows) {
    if (row.vibration_m_per_s > 0.0) {
      vibrating.push_back(&row);
    }
  }
  return *vibrating[vibrating.size() / 2];
}

}  // namespace

std::string scene_text(const Comparison& comparison) {
  const LawFit& best = comparison.best();
  const Reading& row = scene_reading(comparison.readings);
  const Numbers all = numbers(comparison, row);
  const bool forces = comparison.readings.are_forces;
  std::string text = fmt::format(
      R"(# {} as fitted to measured friction, at the reading with a velocity ratio of {:.4g}, a peak
# vibration velocity of {:.4g} m/s. Assumed, because mean friction does not depend on it:
# mass, spring, damping and drive force (together they give that vibration), and the coefficient.
)",
      best.law.title, row.velocity_ratio(), row.vibration_m_per_s);
  for (const std::string& each : best.open) {
    text += fmt::format("# Open: {}\n", each);
  }
  return text + fmt::format(
                    R"([plant]
mass_kg = {:.9g}   # assumed: so heavy that friction does not bend the vibration
stiffness_N_per_m = {:.9g}   # assumed: resonance far below the carrier
damping_N_s_per_m = {:.9g}   # assumed: 10 % of critical damping

[friction]
law = "{}"
coefficient = {:.9g}   # assumed: {}
normal_force_N = {:.9g}   # {}
{}
[sliding]
velocity_m_per_s = {:.9g}

[drive]
frequency_Hz = {:.9g}{}
force_amplitude_N = {:.9g}   # assumed, with the mass

[run]
start = "steady"
duration_periods = 20
)",
                    all.mass_kg, all.stiffness_N_per_m, all.damping_N_s_per_m, best.law.law,
                    assumed_coefficient,
                    forces ? "only its product with the normal force is fitted"
                           : "a friction ratio does not depend on it",
                    all.normal_force_N,
                    forces ? "the fitted friction limit over the coefficient" : "assumed",
                    law_keys(best, all), row.sliding_m_per_s, all.frequency_Hz,
                    row.frequency_Hz > 0.0 ? "" : "   # assumed: the file has none",
                    all.force_amplitude_N);
}

}  // namespace sonoglide::identify::friction
