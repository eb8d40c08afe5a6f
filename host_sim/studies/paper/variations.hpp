/// One parameter of Table 1 at a time: friction and dissipation over the velocity ratio at each of its
/// values.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host_sim/studies/paper/figure_style.hpp"
#include "host_sim/studies/paper/figures.hpp"
#include "host_sim/studies/paper/runs.hpp"

namespace sonoglide::paper {

inline constexpr const char* friction_label = "friction ratio [-]";
inline constexpr const char* dissipation_label = "power dissipation ratio [-]";
inline constexpr const char* velocity_label = "Vt / peak vibration velocity [-]";
inline constexpr output::Span friction_span = {0.0, 1.05};

struct Variation {
  std::string label;  ///< for the key
  std::string name;   ///< for a column, unit included
  scene::Scene scene;
  SimulatedRatios curve;
};

using Edit = std::function<void(scene::Scene&, double)>;

/// The scene with one value after another, each over the velocity ratio.
/// @param label, name  with a place for the value, as in Variation
std::vector<Variation> vary(const scene::Scene& base, const std::vector<double>& values,
                            const char* label, const char* name, const Edit& edit);

/// The velocity ratios, and four columns of each variation.
std::vector<Column> columns(const std::vector<Variation>& variations);

std::vector<output::Chart> charts(const std::vector<Variation>& variations,
                                  const char* friction_title = "(a) Friction ratio",
                                  const char* dissipation_title = "(b) Power dissipation ratio",
                                  Key key = Key::upper_right, output::Span span = {});

/// "384 N: 0.6749, 960 N: 0.5727" at one velocity ratio.
std::string listed(const std::vector<Variation>& variations, double velocity_ratio,
                   std::vector<double> SimulatedRatios::*values);

enum class Trend { rising, falling };

/// Whether the values at one velocity ratio follow the parameter so, all of them.
bool follows(const std::vector<Variation>& variations, double velocity_ratio,
             std::vector<double> SimulatedRatios::*values, Trend trend);

/// Of a statement that the values at one velocity ratio rise or fall with the parameter.
Claim trend(const char* statement, const std::vector<Variation>& variations, double velocity_ratio,
            std::vector<double> SimulatedRatios::*values, Trend expected, const char* why);

/// @param parameters  a sentence
std::string conditions(const char* parameters);

/// That computes the like of one of the variations.
std::string sweep_command(const char* setting);

template <class Item>
std::vector<Item> joined(std::vector<Item> first, const std::vector<Item>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace sonoglide::paper
