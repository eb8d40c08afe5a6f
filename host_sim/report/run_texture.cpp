#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/output/number.hpp"
#include "host_sim/report/run_parts.hpp"
#include "host_sim/report/words.hpp"

// What is told of a texture: its harmonics, and its course over the distance.

namespace sonoglide::report {
namespace {

bool is_mean(const TextureHarmonic& each) {
  return each.harmonic == 0;
}

std::string number_text(const TextureHarmonic& each) {
  return is_mean(each) ? "mean" : fmt::format("{}", each.harmonic);
}

std::string lag_text(const TextureHarmonic& each) {
  return is_mean(each) || each.is_faint ? "-" : figure("{:.1f}", each.lag_deg());
}

std::string amplitude_ratio_text(const TextureHarmonic& each) {
  return each.is_faint ? "-" : figure("{:.4f}", each.amplitude_ratio());
}

/// Not the sign of a mean: it is above 0.
std::string size_text(const TargetUnit& unit, const std::complex<double>& value) {
  const double size = std::abs(value);
  return unit.is_force() ? figure("{:.4g}", size * unit.size) : figure("{:.4f}", size);
}

}  // namespace

nlohmann::ordered_json texture_json(const TextureMeter& meter, const TargetUnit& unit) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  const auto add = [&](nlohmann::ordered_json& json, const char* of, const TextureHarmonic& each,
                       const std::complex<double>& value) {
    json[fmt::format("{}amplitude{}", of, unit.suffix)] =
        output::json_number(std::abs(value) * unit.size);
    if (!is_mean(each)) {
      json[fmt::format("{}phase_deg", of)] = output::json_number(angle_deg(value));
    }
  };
  for (const TextureHarmonic& each : meter.harmonics()) {
    nlohmann::ordered_json json = {{"harmonic", each.harmonic}};
    add(json, "target_", each, each.wanted);
    add(json, "", each, each.rendered);
    all.push_back(std::move(json));
  }
  return all;
}

std::string texture_lines(const scene::Scene& scene, const TextureMeter& meter) {
  const TargetUnit unit = target_unit(scene);
  std::string text =
      fmt::format("texture of {}, {} whole periods of it in the second half of the run\n",
                  output::quantity(scene.controller->texture->period_m, "m"), meter.passes());
  text += fmt::format("{:>8} {:>12} {:>12} {:>10}\n", "harmonic", held_head(unit, "target"),
                      held_head(unit, "reached"), "lag [deg]");
  for (const TextureHarmonic& each : meter.harmonics()) {
    text +=
        fmt::format("{:>8} {:>12} {:>12} {:>10}\n", number_text(each), size_text(unit, each.wanted),
                    size_text(unit, each.rendered), lag_text(each));
  }
  return text;
}

output::Table texture_table(const scene::Scene& scene, const TextureMeter& meter) {
  const TargetUnit unit = target_unit(scene);
  output::Table table{fmt::format("Texture, amplitudes over {} periods of {}", meter.passes(),
                                  output::quantity(scene.controller->texture->period_m, "m")),
                      {"Harmonic", held_head(unit, "Target"), held_head(unit, "Reached"),
                       "Reached over target", "Lag [deg]"},
                      {}};
  for (const TextureHarmonic& each : meter.harmonics()) {
    table.rows.push_back({number_text(each), size_text(unit, each.wanted),
                          size_text(unit, each.rendered), amplitude_ratio_text(each),
                          lag_text(each)});
  }
  return table;
}

output::Section texture_section(const scene::Scene& scene, const TextureMeter& meter) {
  const TargetUnit unit = target_unit(scene);
  std::vector<double> distance_m;
  std::vector<double> wanted;
  std::vector<double> reached;
  for (const TextureMeter::Place& place : meter.places()) {
    distance_m.push_back(place.distance_m);
    wanted.push_back(place.wanted);
    reached.push_back(place.reached);
  }
  const std::string label = unit.is_force() ? "Friction force [N]" : "Friction ratio [-]";
  output::Chart chart{fmt::format("{} over the sliding distance",
                                  unit.is_force() ? "Friction force" : "Friction ratio"),
                      "One value for each carrier period, at the end of the run.",
                      {"Sliding distance [m]"},
                      {label},
                      {},
                      {{"target", std::move(wanted), output::Line::bridged, distance_m, target_pen},
                       {"reached", std::move(reached), output::Line::bridged, distance_m}}};
  return {"Texture", "", {std::move(chart)}};
}

std::vector<std::string> texture_warnings(const scene::Scene& scene, const TextureMeter& meter) {
  constexpr double largest_error = 0.05;
  constexpr double largest_lag_deg = 20.0;
  std::vector<std::string> all;
  if (meter.passes() == 0) {
    all.push_back(fmt::format(
        "No whole period of the texture is passed in the second half of the run, so that its "
        "harmonics are not known. A period of {} takes a longer run.",
        output::quantity(scene.controller->texture->period_m, "m")));
    return all;
  }
  const std::vector<TextureHarmonic> harmonics = meter.harmonics();
  const auto off = [&](const TextureHarmonic& each) {
    const bool size = std::abs(each.amplitude_ratio() - 1.0) > largest_error;
    return size || (!is_mean(each) && std::abs(each.lag_deg()) > largest_lag_deg);
  };
  for (const TextureHarmonic& each : harmonics) {
    const bool told = each.harmonic <= 1 && !each.is_faint;
    if (told && off(each)) {
      all.push_back(fmt::format(
          "The texture's {} is {} times its target{}: more than 5 % or 20 degrees off.",
          is_mean(each) ? "mean" : "first harmonic", figure("{:.3f}", each.amplitude_ratio()),
          is_mean(each) ? "" : fmt::format(" and lags by {} degrees", lag_text(each))));
    }
  }
  return all;
}

}  // namespace sonoglide::report
