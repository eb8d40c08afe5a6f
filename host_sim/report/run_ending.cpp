#include "host_sim/report/run_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "host_sim/output/number.hpp"
#include "host_sim/report/spectrum.hpp"

namespace sonoglide::report {
namespace {

using output::Line;

/// Why the branches of a cycle end elsewhere than they began; empty where they close.
std::string why_open(const report::HysteresisLoop& cycle) {
  if (cycle.backward.force_N.empty()) {
    return "The contact slides forward all the time: there is no way back, so the curve does not "
           "close.";
  }
  if (cycle.forward.displacement_m.empty()) {
    return "";
  }
  const auto [low, high] =
      std::minmax_element(cycle.forward.displacement_m.begin(), cycle.forward.displacement_m.end());
  const double gap_m = cycle.backward.displacement_m.back() - cycle.forward.displacement_m.front();
  constexpr double visible = 0.01;
  const auto is_closed = [span_m = *high - *low](double distance_m) {
    return std::abs(distance_m) < visible * span_m;
  };
  if (is_closed(gap_m)) {
    return "";
  }
  const double unsettled_m = gap_m - cycle.sliding_m;
  std::string text = "It does not close.";
  if (!is_closed(cycle.sliding_m)) {
    text += fmt::format(" The sliding carries the contact {} further in each carrier period.",
                        output::quantity(cycle.sliding_m, "m"));
  }
  if (!is_closed(unsettled_m)) {
    text += fmt::format(" The vibration is not settled, and moves the contact by {} in this one.",
                        output::quantity(unsettled_m, "m"));
  }
  return text;
}

output::Chart hysteresis_panel(const report::HysteresisLoop& cycle) {
  const auto branch = [](const char* label, const report::Branch& each) {
    return output::Curve{label, each.force_N, Line::bridged, each.displacement_m};
  };
  output::Chart chart{"Friction force against displacement",
                      "One cycle of the contact, at the end of the run. " + why_open(cycle),
                      {"Displacement travelled [m]"},
                      {"Friction force [N]"},
                      {},
                      {branch("sliding forward", cycle.forward)}};
  if (!cycle.backward.force_N.empty()) {
    chart.curves.push_back(branch("sliding back", cycle.backward));
  }
  return chart;
}

output::Chart spectrum_panel(const scene::Scene& scene, const loop::Recording& ending) {
  std::vector<double> velocity;
  for (const loop::PlantState& state : ending.state) {
    velocity.push_back(state.velocity_m_per_s);
  }
  if (!velocity.empty()) {
    velocity.pop_back();  // the sample that begins the next carrier period
  }
  const double interval_s = ending.time_s.size() > 1 ? ending.time_s[1] - ending.time_s[0] : 1.0;
  constexpr double harmonics_shown = 5.0;
  const double highest_Hz = scene.drive ? harmonics_shown * scene.drive->frequency_Hz
                                        : std::numeric_limits<double>::infinity();
  report::Spectrum spectrum = report::amplitude_spectrum(velocity, interval_s, highest_Hz);
  return {
      "Velocity spectrum",
      fmt::format("Amplitude, Hann window, {} samples from the end of the run.", velocity.size()),
      {"Frequency [Hz]"},
      {"Velocity amplitude [m/s]", true},
      std::move(spectrum.frequency_Hz),
      {{"velocity", std::move(spectrum.amplitude)}}};
}

}  // namespace

output::Section close_up_section(const scene::Scene& scene, const loop::Recording& recording,
                                 std::size_t index) {
  const auto column = [&recording](auto value) {
    std::vector<double> values;
    for (const loop::PlantState& state : recording.state) {
      values.push_back(value(state));
    }
    return values;
  };
  const auto displacement = [](const loop::PlantState& state) { return state.displacement_m; };
  const auto velocity = [](const loop::PlantState& state) { return state.velocity_m_per_s; };
  const auto friction = [](const loop::PlantState& state) { return state.friction_force_N; };

  output::Section section{"Start", "The first carrier periods.", {}};
  if (scene.controller && !scene.controller->texture) {
    const scene::TargetStep& step = scene.controller->targets()[index];
    section.title = fmt::format("Step to {:.3g}{} at {:.6g} ms", step.value,
                                scene.controller->holds_force() ? " N" : "", step.time_s * 1e3);
    section.text = "The carrier periods around the step.";
  }
  const std::string group = fmt::format("close_up_{}", index);
  const auto panel = [&](const char* title, const char* label, std::vector<double> values) {
    section.charts.push_back(
        {title, "", {"Time [s]"}, {label}, recording.time_s, {{title, std::move(values)}}, group});
  };
  panel("Displacement", "Displacement [m]", column(displacement));
  panel("Velocity", "Vibration velocity [m/s]", column(velocity));
  if (scene.friction.largest_limit_N() > 0.0) {
    panel("Friction force", "Friction force [N]", column(friction));
  }
  return section;
}

output::Section ending_section(const scene::Scene& scene, const loop::Recording& recording) {
  constexpr std::size_t samples = 64;
  output::Section section{"End of the run", "", {}};
  // Across the sliding and normal to it the vibration is no part of the displacement travelled.
  if (scene.friction.largest_limit_N() > 0.0 && scene::vibrates_along(scene.friction.law)) {
    section.charts.push_back(
        hysteresis_panel(report::last_cycle(recording, scene.friction.sign_convention, samples)));
  }
  section.charts.push_back(spectrum_panel(scene, recording));
  return section;
}

}  // namespace sonoglide::report
