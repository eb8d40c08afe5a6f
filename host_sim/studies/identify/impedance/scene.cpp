#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/impedance/study.hpp"

namespace sonoglide::identify::impedance {
namespace {

const Estimate& estimate_of(const Identification& identification, const std::string& name) {
  const auto& all = identification.parameters;
  return *std::find_if(all.begin(), all.end(),
                       [&](const Estimate& each) { return each.name == name; });
}

/// A line of [tolerance]; none where the interval has no width or an end is open.
std::string tolerance_line(const std::string& key, double low, double high) {
  return low < high && std::isfinite(low) && std::isfinite(high)
             ? fmt::format("\"{}\" = {{ range = [{:.15g}, {:.15g}] }}\n", key, low, high)
             : std::string();
}

/// The 95 % intervals of what is identified. Mass and stiffness have errors in common that leave the
/// resonance as it is; keys that vary independently would not, so that the mass keeps its value and
/// the stiffness has the interval of the resonance.
std::string tolerance_lines(const Identification& identification) {
  const double stiffness_N_per_m = estimate_of(identification, "stiffness_N_per_m").value;
  const Estimate& resonance = estimate_of(identification, "resonance_frequency_Hz");
  const auto stiffness_at = [&](double frequency_Hz) {
    const double ratio = frequency_Hz / resonance.value;
    return stiffness_N_per_m * ratio * ratio;
  };
  std::string lines = tolerance_line("plant.stiffness_N_per_m", stiffness_at(resonance.low_95),
                                     stiffness_at(resonance.high_95));
  for (const std::string key : {"plant.damping_N_s_per_m", "transducer.force_factor_N_per_V",
                                "transducer.clamped_capacitance_F"}) {
    const Estimate& found = estimate_of(identification, key.substr(key.find('.') + 1));
    lines += tolerance_line(key, std::max(found.low_95, 0.0), found.high_95);
  }
  return lines;
}

}  // namespace

std::string scene_toml(const ImpedanceStudy& study) {
  const auto value = [&](const char* name) {
    return estimate_of(study.identification, name).value;
  };
  const double damping_N_s_per_m = value("damping_N_s_per_m");
  const double force_factor_N_per_V = value("force_factor_N_per_V");
  const Mode& mode = study.fit.circuit.modes.front();
  const double rad_per_s = two_pi * mode.resonance_Hz;
  // A contact that takes a tenth of the vibration's own losses, and a spring that does not tune it.
  constexpr double sliding_m_per_s = 0.02;
  constexpr double vibration_m_per_s = 0.05;
  constexpr double coefficient = 0.2;
  const double friction_N = 0.1 * damping_N_s_per_m * vibration_m_per_s;
  const double contact_N_per_m = 10.0 * friction_N / (vibration_m_per_s / rad_per_s);
  const double voltage_V =
      4.0 * (damping_N_s_per_m * vibration_m_per_s + friction_N) / force_factor_N_per_V;
  const double settling_s = 2.0 * mode.quality() / rad_per_s;
  const double step_s = std::max(20.0 * settling_s, 100.0 / mode.resonance_Hz);
  const double tangent = study.fit.circuit.loss_tangent;
  return fmt::format(
      R"(# The transducer of {}, from a measured sweep of its impedance.
# Identified: [transducer] but for what is given below, resonance and quality factor {:.5g}.
# Given by hand: {}.
# Assumed, since no sweep tells it: contact, sliding, amplifier and targets.
[plant]
mass_kg = {:.15g}
stiffness_N_per_m = {:.15g}
damping_N_s_per_m = {:.15g}

[friction]
law = "dahl"
coefficient = {:.15g}               # assumed
normal_force_N = {:.6g}             # assumed: friction a tenth of the damping at 0.05 m/s
contact_stiffness_N_per_m = {:.6g}  # assumed: Dahl number 10 there

[sliding]
velocity_m_per_s = {:.15g}          # assumed

[transducer]
force_factor_N_per_V = {:.15g}
clamped_capacitance_F = {:.15g}
loss_tangent = {:.15g}{}

[drive]
frequency_Hz = {:.15g}
max_voltage_amplitude_V = {:.6g}    # assumed: four times what 0.05 m/s takes

[run]
duration_s = {:.6g}

[controller]
arithmetic = "float32"
vibration = "resonant"
target_friction_ratio = [[0.0, 0.4], [{:.6g}, 0.6]]

[sensor]
vibration = "motional_current"     # assumed: no force sensor
force = false

[tolerance]                           # 95 % intervals, for sonoglide robust
{})",
      study.name, mode.quality(),
      study.fact.mass_kg ? fmt::format("the mass, {:g} kg", value("mass_kg"))
                         : fmt::format("the force factor, {:g} N/V", force_factor_N_per_V),
      value("mass_kg"), value("stiffness_N_per_m"), damping_N_s_per_m, coefficient,
      friction_N / coefficient, contact_N_per_m, sliding_m_per_s, force_factor_N_per_V,
      study.fit.circuit.clamped_capacitance_F, std::max(tangent, 0.0),
      tangent < 0.0
          ? fmt::format("                    # fitted: {:.3g}; no capacitor has less than 0",
                        tangent)
          : std::string(),
      mode.resonance_Hz, voltage_V, 2.0 * step_s, step_s, tolerance_lines(study.identification));
}

}  // namespace sonoglide::identify::impedance
