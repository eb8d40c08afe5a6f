#include "host_sim/report/run_notes.hpp"

#include <fmt/format.h>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/report/step_metrics.hpp"

namespace sonoglide::report {
namespace {

/// The controller computes the current from the nominal plant and a noisy vibration.
void append_current_excess(const scene::Scene& scene, const loop::RunResult& result,
                           std::vector<std::string>& notes) {
  if (!scene.drive || !scene.drive->max_current_amplitude_A) {
    return;
  }
  const double limit_A = *scene.drive->max_current_amplitude_A;
  if (result.current_peak_A > told_current_excess * limit_A) {
    notes.push_back(fmt::format(
        "The current reached {:.4g} A, {:.2g} % above its limit of {:.6g} A: the controller does "
        "not measure it but computes it from the nominal plant and the vibration sensor.",
        result.current_peak_A, 100.0 * (result.current_peak_A / limit_A - 1.0), limit_A));
  }
}

void append_contact_loss(const scene::Scene& scene, const loop::RunResult& result,
                         std::vector<std::string>& notes) {
  if (!(result.whole.open_s > 0.0)) {
    return;
  }
  const ContactLoadFigures load = contact_load(result.window);
  const double resting_N =
      configure::contact_at(scene.friction, scene.run.window_start_s).normal_force_N;
  notes.push_back(fmt::format(
      "The vibration opens the contact for {:.3g} % of the time. The law holds the mean gap, not "
      "the mean load: the mean normal force is {:.4g} N, not the {:.4g} N at rest. The friction "
      "ratio is over the friction at rest. Impacts of the open contact are not modelled.",
      100.0 * load.open_fraction, load.mean_normal_force_N, resting_N));
}

}  // namespace

std::vector<std::string> run_notes(const scene::Scene& scene, const loop::RunResult& result) {
  std::vector<std::string> notes;
  append_current_excess(scene, result, notes);
  append_contact_loss(scene, result, notes);
  return notes;
}

std::vector<std::string> target_notes(const scene::Scene& scene) {
  if (!scene.controller || scene.controller->texture) {
    return {};
  }
  const TargetUnit unit = target_unit(scene);
  const char* const newtons = unit.is_force() ? " N" : "";
  const double band = scene.run.settling_band * unit.size;
  std::vector<std::string> notes;
  for (const scene::TargetStep& step : scene.controller->targets()) {
    const std::string target =
        fmt::format("The target {:.6g}{} at {:.6g} s", step.value, newtons, step.time_s);
    if (!(step.time_s < scene.run.duration_s)) {
      notes.push_back(
          fmt::format("{}{} never begins: the run ends at {:.6g} s.", target,
                      &step == &scene.controller->targets().back() ? "" : ", like those after it,",
                      scene.run.duration_s));
      break;
    }
    if (step.value <= band) {
      notes.push_back(fmt::format(
          "{} is within the settling band of {:.6g}{} about 0: that it settles does not tell it from "
          "no friction at all. A smaller run.settling_band does.",
          target, band, newtons));
    }
  }
  return notes;
}

ContactLoadFigures contact_load(const loop::EnergyBalance& window) {
  return {window.open_s / window.duration_s, window.normal_impulse_N_s / window.duration_s};
}

}  // namespace sonoglide::report
