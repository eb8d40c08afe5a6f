#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/report/run_parts.hpp"
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

namespace {

using output::Line;

/// The circle that the admittance runs through near the resonance, without friction, and where the
/// run ended.
output::Chart admittance_chart(const scene::Scene& scene,
                               const std::optional<VibrationCourse::OperatingPoint>& point) {
  constexpr int points = 400;
  constexpr double widths = 8.0;  // of the resonance, to either side
  const scene::Plant& plant = scene.plant;
  const double natural_rad_per_s = plant.natural_rad_per_s();
  const double width = plant.damping_N_s_per_m / plant.mass_kg / natural_rad_per_s;
  const double factor = scene.transducer->force_factor_N_per_V;
  output::Curve below{"below the resonance", {}, Line::bridged};
  output::Curve above{"above the resonance", {}, Line::bridged};
  output::Curve operating{"operating point", {}, Line::dots};
  const auto add = [](output::Curve& curve, std::complex<double> admittance_S) {
    curve.x.push_back(admittance_S.real());
    curve.y.push_back(admittance_S.imag());
  };
  for (int k = -points; k <= points; ++k) {
    const double part = static_cast<double>(k) / points;
    const double rate_rad_per_s =
        natural_rad_per_s * std::max(0.01, 1.0 + widths * width * part * std::abs(part));
    const std::complex<double> motional = factor * factor *
                                          std::complex<double>(0.0, rate_rad_per_s) /
                                          configure::dynamic_stiffness(plant, rate_rad_per_s);
    add(k < 0 ? below : above,
        motional + loop::clamped_admittance_S(*scene.transducer, rate_rad_per_s));
  }
  std::string note = fmt::format(
      "Of the transducer without friction, to {:g} widths of the resonance on either side.",
      widths);
  if (point) {
    add(operating, point->admittance_S);
    note += fmt::format(
        " The operating point is a mean of about the last {:g} carrier periods, at {:.6g} Hz.",
        VibrationCourse::operating_periods, point->frequency_Hz);
  }
  output::Chart chart{"Admittance",
                      std::move(note),
                      {"Conductance [S]"},
                      {"Susceptance [S]"},
                      {},
                      {std::move(below), std::move(above), std::move(operating)}};
  chart.equal_scales = true;
  return chart;
}

}  // namespace

output::Section vibration_section(const scene::Scene& scene, const VibrationCourse& course) {
  const VibrationCourse::Curve& curve = course.curve();
  const std::vector<double> time = curve.x();
  output::Section section{scene.transducer ? "Vibration and current" : "Vibration",
                          "Fundamental of each carrier period.",
                          {}};
  const auto panel = [&](const char* title, const char* label, VibrationCourse::Ordinate ordinate,
                         std::vector<output::Curve> beside) {
    for (output::Curve& each : beside) {
      each.pen = target_pen;
    }
    const bool drive = ordinate == VibrationCourse::frequency_Hz;
    beside.push_back({drive ? "drive" : "fundamental", curve.y(ordinate), Line::stepped});
    section.charts.push_back(course_chart(title, "", label, time, std::move(beside)));
  };
  const auto series = [&](const char* label, VibrationCourse::Ordinate ordinate) {
    return std::vector<output::Curve>{{label, curve.y(ordinate), Line::stepped}};
  };
  const bool resonant = scene.resonant();
  panel("Vibration velocity", "Vibration velocity, amplitude [m/s]",
        VibrationCourse::vibration_m_per_s,
        scene.sensor.vibration ? series("wanted", VibrationCourse::wanted_m_per_s)
                               : std::vector<output::Curve>());
  if (scene.transducer) {
    std::vector<output::Curve> limit;
    if (scene.drive->max_current_amplitude_A) {
      limit.push_back(level("limit", time, *scene.drive->max_current_amplitude_A));
    }
    panel("Current", "Current, amplitude [A]", VibrationCourse::current_A, std::move(limit));
  }
  if (resonant) {
    panel("Frequency", "Frequency [Hz]", VibrationCourse::frequency_Hz,
          series("natural, without contact", VibrationCourse::natural_Hz));
    panel("Phase", "Vibration velocity ahead of the carrier [deg]", VibrationCourse::phase_deg, {});
  } else if (!scene.drive->frequency_profile.empty()) {
    panel("Carrier frequency", "Carrier frequency [Hz]", VibrationCourse::frequency_Hz, {});
  }
  if (resonant) {
    section.charts.push_back(admittance_chart(scene, course.operating_point()));
  }
  return section;
}

}  // namespace sonoglide::report
