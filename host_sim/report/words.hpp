/// How the reports speak: limits, figures, the cost of an image.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// "-" for a figure that is not defined.
inline std::string figure(fmt::format_string<const double&> format, double value) {
  return std::isnan(value) ? "-" : output::plain_zero(fmt::format(format, value));
}

/// A message as a cell of a table: control characters, which would break its line, are blanks.
std::string one_line(std::string text);

/// In which the amplitude of a drive is told.
struct AmplitudeUnit {
  const char* name;  ///< "N", with a transducer "V"
  double per_N;

  std::vector<double> of(std::vector<double> forces_N) const;
};
AmplitudeUnit amplitude_unit(const scene::Scene& scene);

/// A target, and an error with and without its sign, from what StepMetrics has: a friction ratio with
/// as many places as ever, a force to a few digits.
std::string target_figure(const TargetUnit& unit, double part);
std::string error_figure(const TargetUnit& unit, double part);
std::string width_figure(const TargetUnit& unit, double part);
/// The same as the head of a column: `error`, `error [N]`.
std::string held_head(const TargetUnit& unit, const char* name);

/// The limit of a target step, with its cause, how far belief and truth are apart, and whether only
/// the simulation can see it; all where there is something to say.
std::string limit_text(const report::StepMetrics& step);

/// Every figure with its name.
output::Table image_table(const loop::ImageRecord& record);

/// The same for summary.json; what is not known is null.
nlohmann::ordered_json image_json(const loop::ImageRecord& record);

/// The same in two lines.
std::string image_lines(const loop::ImageRecord& record);

}  // namespace sonoglide::report
