#include "host_sim/studies/design/report.hpp"

#include <fmt/format.h>

#include "host_sim/output/number.hpp"
#include "host_sim/studies/design/advice.hpp"

namespace sonoglide::design {

namespace {

std::string drive_line(const Requirement& point) {
  const SteadyMotion& motion = point.motion;
  return fmt::format("{:>10} {:>6.4g} {:>9} {:>10} {:>9} {:>9} {:>9} {:>9}  {}\n",
                     output::quantity(point.sliding_m_per_s, "m/s"), point.ratio,
                     output::quantity(motion.drive_force_N, "N"),
                     output::quantity(motion.velocity_amplitude_m_per_s, "m/s"),
                     output::quantity(motion.displacement_amplitude_m, "m"),
                     output::quantity(motion.drive_power_W, "W"),
                     output::quantity(motion.friction_power_W, "W"),
                     output::quantity(motion.undriven_friction_power_W, "W"), name(point.limit));
}

std::string sensitivity_lines(const std::vector<DesignPoint>& points) {
  if (points.empty()) {
    return {};
  }
  std::string lines = fmt::format("\nd ln ratio / d ln p\n{:>10} {:>6}", "sliding", "ratio");
  for (const Sensitivity& each : points.front().sensitivities) {
    lines += fmt::format(" {:>7}", each.parameter.symbol);
  }
  for (const DesignPoint& point : points) {
    lines +=
        fmt::format("\n{:>10} {:>6.4g}", output::quantity(point.requirement.sliding_m_per_s, "m/s"),
                    point.requirement.ratio);
    for (const Sensitivity& each : point.sensitivities) {
      lines += fmt::format(" {:>7}", output::formatted(each.logarithmic, "{:.3f}"));
    }
  }
  return lines + '\n';
}

std::string text(const DesignStudy& study) {
  std::string lines =
      fmt::format("{:>10} {:>6} {:>9} {:>10} {:>9} {:>9} {:>9} {:>9}  {}\n", "sliding", "ratio",
                  "force", "vibration", "amplitude", "drive", "friction", "undriven", "limit");
  for (const DesignPoint& point : study.points) {
    lines += drive_line(point.requirement);
  }
  lines += sensitivity_lines(moving_points(study)) + '\n';
  for (const std::string& each : shortfalls(study)) {
    lines += fmt::format("UNREACHABLE: {}\n", each);
  }
  for (const Advice& each : advice(study)) {
    lines += fmt::format("{}: {}\n", each.topic, each.sentence);
  }
  return lines;
}

}  // namespace

output::StudyReport report(const DesignStudy& study) {
  return {{{"report.html", output::to_html(page(study))},
           {"design.json", to_json(study).dump(2) + '\n'},
           {"design.csv", requirements_csv(study)},
           {"detuning.csv", detuning_csv(study)}},
          text(study)};
}

}  // namespace sonoglide::design
