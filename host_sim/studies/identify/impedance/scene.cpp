#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/impedance/report.hpp"

namespace sonoglide::identify::impedance {
namespace {

const Estimate& estimate_of(const Identification& identification, const std::string& name) {
  const auto& all = identification.parameters;
  return *std::find_if(all.begin(), all.end(),
                       [&](const Estimate& each) { return each.name == name; });
}

double value_of(const Identification& identification, const std::string& name) {
  return estimate_of(identification, name).value;
}

/// A line of [tolerance]; none where the interval has no width or an end is open.
std::string tolerance_line(const char* key, double low, double high) {
  return low < high && std::isfinite(low) && std::isfinite(high)
             ? fmt::format("\"{}\" = {{ range = [{:.17g}, {:.17g}] }}\n", key, low, high)
             : std::string();
}

/// The 95 % intervals of what is identified. Mass and stiffness have errors in common that leave the
/// resonance as it is; keys that vary independently would not, so that the mass keeps its value and
/// the stiffness has the interval of the resonance.
std::string tolerance_toml(const Identification& identification) {
  const double stiffness_N_per_m = value_of(identification, "stiffness_N_per_m");
  const Estimate& resonance = estimate_of(identification, "resonance_frequency_Hz");
  const auto stiffness_at = [&](double frequency_Hz) {
    const double ratio = frequency_Hz / resonance.value;
    return stiffness_N_per_m * ratio * ratio;
  };
  const auto line = [&](const char* key, const char* name) {
    const Estimate& found = estimate_of(identification, name);
    return tolerance_line(key, std::max(found.low_95, 0.0), found.high_95);
  };
  return "\n[tolerance]                           # 95 % intervals, for sonoglide robust\n" +
         tolerance_line("plant.stiffness_N_per_m", stiffness_at(resonance.low_95),
                        stiffness_at(resonance.high_95)) +
         line("plant.damping_N_s_per_m", "damping_N_s_per_m") +
         line("transducer.force_factor_N_per_V", "force_factor_N_per_V") +
         line("transducer.clamped_capacitance_F", "clamped_capacitance_F");
}

std::string remark_on_loss(double tangent) {
  return tangent < 0.0
             ? fmt::format("                    # fitted: {:.3g}; no capacitor has less than 0",
                           tangent)
             : std::string();
}

}  // namespace

std::string scene_toml(const ImpedanceStudy& study) {
  const Identification& identification = study.identification;
  const double mass_kg = value_of(identification, "mass_kg");
  const double stiffness_N_per_m = value_of(identification, "stiffness_N_per_m");
  const double damping_N_s_per_m = value_of(identification, "damping_N_s_per_m");
  const double force_factor_N_per_V = value_of(identification, "force_factor_N_per_V");
  const Mode& mode = study.fit.circuit.modes.front();
  const double resonance_Hz = mode.resonance_Hz;
  // A contact that takes a tenth of the vibration's own losses, and a spring that does not tune it.
  constexpr double sliding_m_per_s = 0.02;
  constexpr double vibration_m_per_s = 0.05;
  constexpr double coefficient = 0.2;
  const double friction_N = 0.1 * damping_N_s_per_m * vibration_m_per_s;
  const double amplitude_m = vibration_m_per_s / (two_pi * resonance_Hz);
  const double contact_N_per_m = 10.0 * friction_N / amplitude_m;
  const double voltage_V =
      4.0 * (damping_N_s_per_m * vibration_m_per_s + friction_N) / force_factor_N_per_V;
  const double settling_s = 2.0 * mode.quality() / (two_pi * resonance_Hz);
  const double step_s = std::max(20.0 * settling_s, 100.0 / resonance_Hz);
  const double tangent = study.fit.circuit.loss_tangent;
  const double loss = std::max(tangent, 0.0);
  const std::string measured = fmt::format(
      "# The transducer of {}, from a measured sweep of its impedance.\n"
      "# Identified: [transducer] but for what is given below, resonance and quality factor "
      "{:.5g}.\n"
      "# Given by hand: {}.\n"
      "# Assumed, since no sweep tells it: contact, sliding, amplifier and targets.\n"
      "[plant]\n"
      "mass_kg = {:.17g}\n"
      "stiffness_N_per_m = {:.17g}\n"
      "damping_N_s_per_m = {:.17g}\n\n"
      "[friction]\n"
      "law = \"dahl\"\n"
      "coefficient = {:.17g}               # assumed\n"
      "normal_force_N = {:.6g}             # assumed: friction a tenth of the damping at 0.05 m/s\n"
      "contact_stiffness_N_per_m = {:.6g}  # assumed: Dahl number 10 there\n\n"
      "[sliding]\n"
      "velocity_m_per_s = {:.17g}          # assumed\n\n"
      "[transducer]\n"
      "force_factor_N_per_V = {:.17g}\n"
      "clamped_capacitance_F = {:.17g}\n"
      "loss_tangent = {:.17g}{}\n\n"
      "[drive]\n"
      "frequency_Hz = {:.17g}\n"
      "max_voltage_amplitude_V = {:.6g}    # assumed: four times what 0.05 m/s takes\n\n"
      "[run]\n"
      "duration_s = {:.6g}\n\n"
      "[controller]\n"
      "arithmetic = \"float32\"\n"
      "vibration = \"resonant\"\n"
      "target_friction_ratio = [[0.0, 0.4], [{:.6g}, 0.6]]\n\n"
      "[sensor]\n"
      "vibration = \"motional_current\"     # assumed: no force sensor\n"
      "force = false\n",
      study.name, mode.quality(),
      study.fact.mass_kg ? fmt::format("the mass, {:g} kg", mass_kg)
                         : fmt::format("the force factor, {:g} N/V", force_factor_N_per_V),
      mass_kg, stiffness_N_per_m, damping_N_s_per_m, coefficient, friction_N / coefficient,
      contact_N_per_m, sliding_m_per_s, force_factor_N_per_V,
      study.fit.circuit.clamped_capacitance_F, loss, remark_on_loss(tangent), resonance_Hz,
      voltage_V, 2.0 * step_s, step_s);
  return measured + tolerance_toml(identification);
}

}  // namespace sonoglide::identify::impedance
