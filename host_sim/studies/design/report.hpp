/// The files and the printed page that a design leaves behind.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/studies/design/study.hpp"

namespace sonoglide::design {

// What a design comes to, in words.

struct Advice {
  std::string topic;
  std::string sentence;
};

/// Whether each ratio is within reach and how far, what the closed form is worth, power, accuracy,
/// and which way resonance lies; with a transducer, what the amplifier must give and what would help.
std::vector<Advice> advice(const DesignStudy& study);

/// What cannot be had, and the nearest that can; empty where everything is within reach.
std::vector<std::string> shortfalls(const DesignStudy& study);

/// One line for each ratio and speed, 17 digits.
std::string requirements_csv(const DesignStudy& study);

/// One line for each ratio and tuning Ks/(m w²), at the fastest of the task's speeds, 17 digits.
std::string detuning_csv(const DesignStudy& study);

/// The design points with their sensitivities, the reach of each ratio, and the tuning bands.
nlohmann::ordered_json to_json(const DesignStudy& study);

/// Required force and power over the sliding speed, with what is more than the drive has.
std::vector<output::Chart> requirement_charts(const DesignStudy& study);

/// Bars of d ln rho/d ln p at the fastest of the task's speeds, a colour a ratio; some ratio has a
/// motion there.
output::Chart sensitivity_chart(const DesignStudy& study);

/// Over the tuning Ks/(m w²): the ratio under the scene's force, the force that keeps it, and what
/// 1 % of the spring then costs; some ratio has a motion.
std::vector<output::Chart> detuning_charts(const DesignStudy& study);

/// What keeps the natural mode quiet, the cheapest controller that holds the plant, and a carrier at
/// which the mode is far from trouble.
std::vector<Advice> natural_mode_advice(const NaturalModeStudy& mode);
output::Section natural_mode_section(const DesignStudy& study, const NaturalModeStudy& mode);
nlohmann::ordered_json to_json(const NaturalModeStudy& mode);

/// Whether steady sliding feeds an oscillation, and what the drive does to it; of friction that falls.
Advice self_excitation_advice(const SelfExcitation& found);
output::Section self_excitation_section(const DesignStudy& study);
nlohmann::ordered_json to_json(const SelfExcitation& found);

output::Page page(const DesignStudy& study);

/// report.html, design.json, design.csv and detuning.csv.
output::StudyReport report(const DesignStudy& study);

}  // namespace sonoglide::design
