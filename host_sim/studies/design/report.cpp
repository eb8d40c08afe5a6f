#include "host_sim/studies/design/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/studies/design/advice.hpp"

namespace sonoglide::design {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("-");
}

std::string fixed(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string("-");
}

std::string quantity(double value, const char* unit) {
  if (!std::isfinite(value) || value == 0.0) {
    return std::isfinite(value) ? fmt::format("0 {}", unit) : std::string("-");
  }
  static constexpr const char* prefixes[] = {"p", "n", "u", "m", "", "k", "M", "G"};
  constexpr int without = 4;
  constexpr int last = 7;
  // What rounds to 1000 has the next prefix.
  const double thousands = std::floor(std::log10(std::abs(value) * (1.0 + 5e-5)) / 3.0);
  const int index = std::clamp(static_cast<int>(thousands) + without, 0, last);
  return fmt::format("{:.4g} {}{}", value * std::pow(1000.0, without - index), prefixes[index],
                     unit);
}

namespace {

std::string drive_line(const Requirement& point) {
  const SteadyMotion& motion = point.motion;
  return fmt::format("{:>10} {:>6.4g} {:>9} {:>10} {:>9} {:>9} {:>9} {:>9}  {}\n",
                     quantity(point.sliding_m_per_s, "m/s"), point.ratio,
                     quantity(motion.drive_force_N, "N"),
                     quantity(motion.velocity_amplitude_m_per_s, "m/s"),
                     quantity(motion.displacement_amplitude_m, "m"),
                     quantity(motion.drive_power_W, "W"), quantity(motion.friction_power_W, "W"),
                     quantity(motion.undriven_friction_power_W, "W"), name(point.limit));
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
    lines += fmt::format("\n{:>10} {:>6.4g}", quantity(point.requirement.sliding_m_per_s, "m/s"),
                         point.requirement.ratio);
    for (const Sensitivity& each : point.sensitivities) {
      lines += fmt::format(" {:>7}", fixed(each.logarithmic, 3));
    }
  }
  return lines + '\n';
}

}  // namespace

void write(const std::filesystem::path& out, const DesignStudy& study) {
  const std::string html = output::to_html(page(study));
  output::OutputFolder folder(out);
  folder.write("report.html", html);
  folder.write("design.json", to_json(study).dump(2) + '\n');
  folder.write("design.csv", requirements_csv(study));
  folder.write("detuning.csv", detuning_csv(study));
  folder.commit();
}

std::string text(const DesignStudy& study, const std::filesystem::path& out) {
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
  return lines + fmt::format("report: {}\n", process::printable((out / "report.html").string()));
}

}  // namespace sonoglide::design
