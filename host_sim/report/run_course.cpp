#include "host_sim/report/run_parts.hpp"

#include <fmt/format.h>

#include <utility>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/report/words.hpp"

namespace sonoglide::report {
namespace {

using output::Line;

std::string course_text(const scene::Scene& scene, const Course::Curve& curve) {
  if (!scene.drive) {
    return "One value for each thousandth of the run.";
  }
  if (curve.piece_size() == 1) {
    return "One value for each carrier period.";
  }
  return fmt::format("Smallest and largest value of every {} carrier periods.{}",
                     curve.piece_size(),
                     scene.run.record.empty() ? "" : " All of them are in periods.csv.");
}

std::vector<double> limits_N(const scene::Friction& friction, const std::vector<double>& time_s) {
  std::vector<double> limits;
  limits.reserve(time_s.size());
  for (const double time : time_s) {
    limits.push_back(configure::contact_at(friction, time).limit_N());
  }
  return limits;
}

/// As it passes: at once at the beginning of a period, or along a line from 0 to the amplitude at the
/// end of each.
output::Curve amplitude_curve(const scene::Scene& scene, const std::vector<double>& begin_s,
                              std::vector<double> amplitude) {
  if (scene.drive->interpolation == scene::Interpolation::step || begin_s.empty()) {
    return {"amplitude", std::move(amplitude), Line::stepped};
  }
  std::vector<double> end_s(begin_s.begin() + 1, begin_s.end());
  end_s.push_back(scene.run.duration_s);
  end_s.insert(end_s.begin(), begin_s.front());
  amplitude.insert(amplitude.begin(), 0.0);
  return {"amplitude", std::move(amplitude), Line::joined, std::move(end_s)};
}

}  // namespace

output::Curve level(const char* label, const std::vector<double>& x, double value) {
  return {label, std::vector<double>(x.size(), value), Line::joined, {}, target_pen};
}

output::Chart course_chart(const char* title, const char* note, const std::string& label,
                           const std::vector<double>& time, std::vector<output::Curve> curves) {
  return {title, note, {"Time [s]"}, {label}, time, std::move(curves), "course"};
}

output::Section course_section(const scene::Scene& scene, const Course::Curve& curve) {
  const std::vector<double> time = curve.x();
  const auto series = [&curve](const char* label, Course::Ordinate ordinate) {
    return output::Curve{label, curve.y(ordinate), Line::stepped};
  };

  output::Section section{"Course of the run", course_text(scene, curve), {}};
  const auto add = [&](const char* title, const char* note, const std::string& label,
                       std::vector<output::Curve> curves) {
    section.charts.push_back(course_chart(title, note, label, time, std::move(curves)));
  };
  const TargetUnit unit_of_target = target_unit(scene);
  std::vector<output::Curve> held;
  if (scene.controller) {
    const double half_width = scene.run.settling_band * unit_of_target.size;
    output::Curve target = series("target", Course::target);
    target.pen = target_pen;
    if (!scene.controller->texture) {
      output::Curve band = target;
      band.label = fmt::format("target \u00b1 {:.3g}{}, in which it is settled", half_width,
                               unit_of_target.is_force() ? " N" : "");
      band.line = Line::band;
      band.half_width.assign(time.size(), half_width);
      held.push_back(std::move(band));
    }
    held.push_back(std::move(target));
  }
  if (unit_of_target.is_force()) {
    held.push_back(series("reached", Course::friction_force_N));
    add("Friction force", "Mean over a carrier period, along the sliding.", "Friction force [N]",
        std::move(held));
    held.clear();
  }
  if (scene.friction.largest_limit_N() > 0.0) {
    std::vector<output::Curve> ratios = std::move(held);
    ratios.push_back(series("reached", Course::friction_ratio));
    add("Friction ratio",
        "Mean friction force over a carrier period, divided by the undriven one at that "
        "sliding speed and friction.",
        "Friction ratio [-]", std::move(ratios));
  }
  if (scene.friction.has_profile()) {
    add("Friction limit", "", "Coefficient times normal force [N]",
        {{"limit", limits_N(scene.friction, time), Line::stepped}});
  }
  if (scene.drive) {
    const AmplitudeUnit unit = amplitude_unit(scene);
    const double most = scene.max_drive_force_N() * unit.per_N;
    std::vector<output::Curve> amplitudes = {
        amplitude_curve(scene, time, unit.of(curve.y(Course::drive_amplitude_N)))};
    if (scene.resonant()) {
      amplitudes.push_back(level("limit", time, most));
      amplitudes.push_back(level("limit, phase turned", time, -most));
    }
    add("Drive amplitude", scene.resonant() ? "Below 0 the phase is turned by π." : "",
        fmt::format("Drive {} amplitude [{}]", scene.transducer ? "voltage" : "force", unit.name),
        std::move(amplitudes));
  }
  if (scene.drive && scene.drive->bias_limit_N > 0.0) {
    add("Bias", "A force that is constant over a carrier period, beside the drive.",
        "Bias force [N]",
        {series("bias", Course::bias_N), level("largest", time, scene.drive->bias_limit_N),
         level("smallest", time, -scene.drive->bias_limit_N)});
  }
  if (scene.load || scene.sliding.profile.size() > 1) {
    add("Sliding velocity", "", "Sliding velocity [m/s]",
        {series("sliding", Course::sliding_velocity_m_per_s)});
  }
  if (scene.load) {
    add("Displacement of the load", "", "Displacement [m]",
        {series("displacement", Course::load_displacement_m)});
  }
  return section;
}

}  // namespace sonoglide::report
