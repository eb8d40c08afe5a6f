#include "host_sim/studies/paper/variations.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace sonoglide::paper {
namespace {

constexpr const char* windows =
    "From rest (x = x' = F = 0): mean over the first 100 carrier periods. Steady orbit: mean "
    "over one carrier period, which is the mean of ever after.";

output::Chart ratio_chart(const char* title, const char* y_label,
                          const std::vector<Variation>& variations,
                          std::vector<double> SimulatedRatios::*steady,
                          std::vector<double> SimulatedRatios::*from_rest, Key key,
                          output::Span span) {
  std::vector<output::Curve> curves;
  int colour = black;
  for (const Variation& each : variations) {
    ++colour;
    curves.push_back(
        curve(each.label, velocity_ratios(), each.curve.*steady, colour, Style::marked));
    curves.push_back(curve("", velocity_ratios(), each.curve.*from_rest, colour, Style::dashed));
  }
  curves.push_back(curve("from rest", {}, {}, black, Style::dashed));
  return chart(title, velocity_label, y_label, std::move(curves), key, span);
}

}  // namespace

std::vector<Variation> vary(const scene::Scene& base, const std::vector<double>& values,
                            const char* label, const char* name, const Edit& edit) {
  std::vector<Variation> variations;
  for (const double value : values) {
    scene::Scene scene = base;
    edit(scene, value);
    SimulatedRatios curve = ratio_curve(scene, sliding_velocities_m_per_s(scene));
    variations.push_back({fmt::format(fmt::runtime(label), value),
                          fmt::format(fmt::runtime(name), value), scene, std::move(curve)});
  }
  return variations;
}

std::vector<Column> columns(const std::vector<Variation>& variations) {
  std::vector<Column> all = {{"velocity_ratio", velocity_ratios()}};
  for (const Variation& each : variations) {
    all.push_back({each.name + "_friction_ratio_from_rest", each.curve.friction_from_rest});
    all.push_back({each.name + "_friction_ratio_steady", each.curve.friction_steady});
    all.push_back({each.name + "_dissipation_ratio_from_rest", each.curve.dissipation_from_rest});
    all.push_back({each.name + "_dissipation_ratio_steady", each.curve.dissipation_steady});
  }
  return all;
}

std::vector<output::Chart> charts(const std::vector<Variation>& variations,
                                  const char* friction_title, const char* dissipation_title,
                                  Key key, output::Span span) {
  return {ratio_chart(friction_title, friction_label, variations, &SimulatedRatios::friction_steady,
                      &SimulatedRatios::friction_from_rest, Key::none, friction_span),
          ratio_chart(dissipation_title, dissipation_label, variations,
                      &SimulatedRatios::dissipation_steady, &SimulatedRatios::dissipation_from_rest,
                      key, span)};
}

std::string listed(const std::vector<Variation>& variations, double velocity_ratio,
                   std::vector<double> SimulatedRatios::*values) {
  std::string text = fmt::format("At a velocity ratio of {:g}: ", velocity_ratio);
  const char* separator = "";
  for (const Variation& each : variations) {
    text += fmt::format("{}{}: {:.4f}", separator, each.label,
                        (each.curve.*values)[index_of(velocity_ratio)]);
    separator = "; ";
  }
  return text + ". ";
}

bool follows(const std::vector<Variation>& variations, double velocity_ratio,
             std::vector<double> SimulatedRatios::*values, Trend trend) {
  for (std::size_t i = 1; i < variations.size(); ++i) {
    const double before = (variations[i - 1].curve.*values)[index_of(velocity_ratio)];
    const double after = (variations[i].curve.*values)[index_of(velocity_ratio)];
    if (!(trend == Trend::rising ? after > before : after < before)) {
      return false;
    }
  }
  return true;
}

Claim trend(const char* statement, const std::vector<Variation>& variations, double velocity_ratio,
            std::vector<double> SimulatedRatios::*values, Trend expected, const char* why) {
  return {statement, verdict(follows(variations, velocity_ratio, values, expected)),
          "Steady orbit. " + listed(variations, velocity_ratio, values) + why};
}

std::string conditions(const char* parameters) {
  return fmt::format("{} {} With symbols: steady orbit; dashed: from rest.", parameters, windows);
}

std::string sweep_command(const char* setting) {
  return fmt::format(
      "sonoglide sweep table_1.toml --vary velocity_ratio=0.05:1.2:24 {} (and once more with --set "
      "run.start=steady)",
      setting);
}

}  // namespace sonoglide::paper
