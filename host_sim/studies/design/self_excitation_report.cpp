#include <fmt/format.h>

#include <string>
#include <vector>

#include "host_sim/output/number.hpp"
#include "host_sim/report/self_excitation.hpp"
#include "host_sim/studies/design/report.hpp"

namespace sonoglide::design {
namespace {

const char* words(steady::Fate fate) {
  switch (fate) {
    case steady::Fate::dies_out:
      return "is stable";
    case steady::Fate::grows:
      return "feeds an oscillation";
    case steady::Fate::stays:
      return "is undamped";
    case steady::Fate::unknown:
      break;
  }
  return "was not found";
}

/// The windows of one fate as ranges of force; empty where there is none.
std::string ranges(const std::vector<steady::DriveWindow>& windows, steady::Fate fate) {
  std::string text;
  for (const steady::DriveWindow& each : windows) {
    if (each.fate == fate) {
      text += fmt::format("{}{} to {}", text.empty() ? "" : ", ", output::quantity(each.low_N, "N"),
                          output::quantity(each.high_N, "N"));
    }
  }
  return text;
}

nlohmann::ordered_json windows_json(const std::vector<steady::DriveWindow>& windows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const steady::DriveWindow& each : windows) {
    all.push_back({{"from_N", each.low_N}, {"to_N", each.high_N}, {"fate", name(each.fate)}});
  }
  return all;
}

}  // namespace

Advice self_excitation_advice(const SelfExcitation& found) {
  std::string sentence =
      fmt::format("Undriven, steady sliding at {} {}.",
                  output::quantity(found.sliding_m_per_s, "m/s"), words(found.undriven));
  if (const std::string stable = ranges(found.windows, steady::Fate::dies_out); !stable.empty()) {
    sentence += fmt::format(" It is stable under a drive of {}", stable);
    const std::string unstable = ranges(found.windows, steady::Fate::grows);
    sentence +=
        unstable.empty() ? "." : fmt::format(", and feeds an oscillation under {}.", unstable);
  }
  sentence += ' ' + report::missed_windows_text(found.windows.back().high_N);
  return {"Self-excitation", sentence};
}

output::Section self_excitation_section(const DesignStudy& study) {
  output::Section section;
  section.title = "Self-excited oscillation";
  section.text = fmt::format(
      "The friction of this contact falls with the velocity, and can feed an oscillation of the mass "
      "on its spring. The steady motion under a constant drive is stable where its Floquet "
      "multipliers over a carrier period are below 1. \"By averaging\": the mean friction under a "
      "sinusoidal vibration, as a force that changes with the sliding velocity, damps a slow natural "
      "mode. {} The command sonoglide stability SCENE.toml --self-excited draws the map over speed and "
      "drive.",
      report::missed_windows_text(study.self_excitation.front().windows.back().high_N));
  output::Table table{"", {"Sliding", "Found by", "From", "To", "Steady sliding"}, {}};
  const auto add = [&](const SelfExcitation& each, const char* by,
                       const std::vector<steady::DriveWindow>& windows) {
    for (const steady::DriveWindow& window : windows) {
      table.rows.push_back({output::quantity(each.sliding_m_per_s, "m/s"), by,
                            output::quantity(window.low_N, "N"),
                            output::quantity(window.high_N, "N"), words(window.fate)});
    }
  };
  for (const SelfExcitation& each : study.self_excitation) {
    add(each, "the steady motion", each.windows);
    add(each, "averaging", each.averaged_windows);
  }
  section.tables = {std::move(table)};
  return section;
}

nlohmann::ordered_json to_json(const SelfExcitation& found) {
  return {{"sliding_velocity_m_per_s", found.sliding_m_per_s},
          {"undriven", name(found.undriven)},
          {"windows", windows_json(found.windows)},
          {"averaged_windows", windows_json(found.averaged_windows)}};
}

}  // namespace sonoglide::design
