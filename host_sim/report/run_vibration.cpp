#include "host_sim/report/run_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::report {
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
