#include "host_sim/studies/paper/experiments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/normal_vibration_ratio.hpp"
#include "host_sim/output/number.hpp"

namespace sonoglide::paper {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* luo_doi = "10.1038/s41598-024-73652-w";
constexpr const char* dong_doi = "10.3791/52931";

Interval at(double value) {
  return {value, value};
}

const std::vector<PublishedMeasurement>& measurements() {
  static const std::vector<PublishedMeasurement> list = {
      {"Luo 2024 static", luo_doi, Direction::along, at(0.0), at(luo_static_reduction)},
      {"Luo 2024", luo_doi, Direction::along, at(luo_slow_m_per_s), at(luo_slow_reduction)},
      {"Luo 2024 over all speeds",
       luo_doi,
       Direction::along,
       {0.0, luo_fastest_m_per_s},
       luo_reductions},
      {"Dong and Dapino 2015", dong_doi, Direction::normal, at(dong_velocities_m_per_s[0]),
       at(dong_reductions[0])},
      {"Dong and Dapino 2015", dong_doi, Direction::normal, at(dong_velocities_m_per_s[1]),
       at(dong_reductions[1])},
      {"Bharadwaj and Dapino 2010 (seat belt)", "-", Direction::normal, at(unknown), at(0.6)}};
  return list;
}

struct Law {
  const char* name;
  const char* over;
  Direction direction;
  Interval (*reduction)(double velocity_m_per_s);
};

constexpr Law laws[] = {
    {"Coulomb", "", Direction::along, luo_coulomb},
    {"Dahl", luo_dahl_range, Direction::along, luo_dahl},
    {"LuGre", luo_lugre_range, Direction::along, luo_lugre},
    {"Iwan", luo_iwan_range, Direction::along, luo_iwan},
    {"Stribeck", luo_stribeck_range, Direction::along, luo_stribeck},
    {"Coulomb with springs under normal vibration", dong_range, Direction::normal, dong_normal}};

const char* word(Direction direction) {
  return direction == Direction::along ? "along" : "normal";
}

Interval predicted(const Law& law, const PublishedMeasurement& measurement) {
  if (law.direction != measurement.direction) {
    return {0.0, 0.0};
  }
  const Interval& velocity = measurement.velocity_m_per_s;
  if (std::isnan(velocity.least)) {
    return joined(law.reduction(0.0), {0.0, 0.0});
  }
  return joined(law.reduction(velocity.least), law.reduction(velocity.most));
}

MeasurementComparison compare(const PublishedMeasurement& measurement) {
  MeasurementComparison comparison{measurement, {}};
  for (const Law& law : laws) {
    const bool own = law.direction == measurement.direction;
    comparison.predictions.push_back({law.name, law.direction,
                                      own ? law.over : "vibration in another direction",
                                      predicted(law, measurement)});
  }
  return comparison;
}

std::string percent(const Interval& range) {
  return range.least == range.most
             ? fmt::format("{:.4g}", 100.0 * range.least)
             : fmt::format("{:.4g} to {:.4g}", 100.0 * range.least, 100.0 * range.most);
}

std::string speed(const Interval& velocity_m_per_s) {
  if (std::isnan(velocity_m_per_s.least)) {
    return "not given";
  }
  return velocity_m_per_s.least == velocity_m_per_s.most
             ? fmt::format("{:g}", 1e3 * velocity_m_per_s.least)
             : fmt::format("{:g} to {:g}", 1e3 * velocity_m_per_s.least,
                           1e3 * velocity_m_per_s.most);
}

std::string points(double difference) {
  return difference == 0.0 ? "0" : fmt::format("{:+.1f}", 100.0 * difference);
}

std::string numbers(const Interval& range) {
  constexpr int digits = 9;
  return output::csv_cells({range.least, range.most}, digits);
}

}  // namespace

double Prediction::difference(const PublishedMeasurement& measurement) const {
  if (reduction.least > measurement.reduction.most) {
    return reduction.least - measurement.reduction.most;
  }
  if (reduction.most < measurement.reduction.least) {
    return reduction.most - measurement.reduction.least;
  }
  return 0.0;
}

std::vector<MeasurementComparison> compare_measurements() {
  std::vector<MeasurementComparison> comparisons;
  for (const PublishedMeasurement& measurement : measurements()) {
    comparisons.push_back(compare(measurement));
  }
  return comparisons;
}

output::Table measurement_table(const std::vector<MeasurementComparison>& comparisons) {
  output::Table table{
      "Published measurements and the laws for their direction of vibration",
      {"Measurement", "Speed, mm/s", "Reduction, %", "Law", "It says, %", "Difference, points"},
      {}};
  for (const MeasurementComparison& each : comparisons) {
    for (const Prediction& prediction : each.predictions) {
      if (prediction.direction == each.measurement.direction) {
        table.rows.push_back({each.measurement.source, speed(each.measurement.velocity_m_per_s),
                              percent(each.measurement.reduction), prediction.law,
                              percent(prediction.reduction),
                              points(prediction.difference(each.measurement))});
      }
    }
  }
  return table;
}

std::string measurements_csv(const std::vector<MeasurementComparison>& comparisons) {
  std::string text =
      "source,doi,vibration,velocity_from_m_per_s,velocity_to_m_per_s,measured_reduction_from,"
      "measured_reduction_to,law,over,predicted_reduction_from,predicted_reduction_to,difference\n";
  for (const MeasurementComparison& each : comparisons) {
    const PublishedMeasurement& m = each.measurement;
    for (const Prediction& prediction : each.predictions) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{:.9g}\n", m.source, m.doi,
                     word(m.direction), numbers(m.velocity_m_per_s), numbers(m.reduction),
                     prediction.law, prediction.over, numbers(prediction.reduction),
                     prediction.difference(m));
    }
  }
  return text;
}

namespace {

constexpr double luo_speeds_mm_per_s[] = {0.05, 0.1, 0.25, 0.5, 0.75, 1.0};
constexpr double critical_velocities_mm_per_s[] = {50.0, 100.0, 200.0, 400.0};
constexpr double per_cent = 100.0;

double dahl_reduction_at_low_speed(double dahl_number) {
  constexpr double softest = 1e-4;
  return 1.0 - friction::dahl_friction_ratio(luo_slow_m_per_s / luo_peak_m_per_s(),
                                             std::max(dahl_number, softest));
}

/// Of a vibration as large as the indentation; a smaller one gives as much less.
double normal_reduction(double velocity_mm_per_s, double critical_mm_per_s) {
  return 1.0 - friction::normal_vibration_ratio(1.0, velocity_mm_per_s / critical_mm_per_s);
}

std::vector<double> ends(const std::vector<Interval>& ranges, double Interval::*end) {
  std::vector<double> values;
  values.reserve(ranges.size());
  for (const Interval& range : ranges) {
    values.push_back(range.*end);
  }
  return values;
}

/// The outline of a range over the speed.
output::Curve area(const char* label, const std::vector<double>& x,
                   const std::vector<Interval>& ranges, int colour) {
  output::Curve outline = curve(label, x, output::scaled(ends(ranges, &Interval::least), per_cent),
                                colour, Style::area);
  const std::vector<double> back = output::scaled(ends(ranges, &Interval::most), per_cent);
  outline.x.insert(outline.x.end(), x.rbegin(), x.rend());
  outline.y.insert(outline.y.end(), back.rbegin(), back.rend());
  return outline;
}

}  // namespace

SlowSliding slow_sliding() {
  SlowSliding slow;
  for (const double speed_mm_per_s : luo_speeds_mm_per_s) {
    const double speed_m_per_s = 1e-3 * speed_mm_per_s;
    slow.speeds_mm_per_s.push_back(speed_mm_per_s);
    slow.coulomb.push_back(luo_coulomb(speed_m_per_s));
    slow.dahl.push_back(luo_dahl(speed_m_per_s));
    slow.lugre.push_back(luo_lugre(speed_m_per_s));
    slow.stribeck.push_back(luo_stribeck(speed_m_per_s));
  }
  return slow;
}

output::Chart slow_sliding_chart(const SlowSliding& slow) {
  const std::vector<double>& x = slow.speeds_mm_per_s;
  std::vector<Interval> every_law;
  for (std::size_t i = 0; i < x.size(); ++i) {
    every_law.push_back(
        joined(joined(slow.coulomb[i], slow.dahl[i]), joined(slow.lugre[i], slow.stribeck[i])));
  }
  return chart(
      "(b) Longitudinal vibration, slow sliding", "sliding velocity [mm/s]",
      "reduction of friction [%]",
      {area("Coulomb, Dahl, LuGre, Stribeck", x, every_law, 1),
       area("measured, all speeds", {0.0, x.back()}, {luo_reductions, luo_reductions}, black),
       curve("measured", {0.0, 1e3 * luo_slow_m_per_s},
             {per_cent * luo_static_reduction, per_cent * luo_slow_reduction}, black,
             Style::points)},
      Key::lower_right, {50.0, 102.0});
}

output::Chart contact_stiffness_chart() {
  constexpr double stiffest = 2.0;
  output::Curve stick =
      line_of([](double number) { return per_cent * elastic_stick_reduction(number); }, stiffest, 5,
              "Iwan, one spring");
  stick.pen.dash = 2;
  stick.pen.width = 1.6;
  return chart(
      "(c) The same at 0.1 mm/s; Iwan: speed to 0", "Kt X/Fc [-]", "reduction of friction [%]",
      {curve("measured", {0.0, stiffest},
             {per_cent * luo_slow_reduction, per_cent * luo_slow_reduction}, black),
       line_of([](double number) { return per_cent * dahl_reduction_at_low_speed(number); },
               stiffest, 2, "Dahl"),
       stick},
      Key::lower_right, {0.0, 105.0});
}

output::Chart normal_vibration_chart() {
  std::vector<output::Curve> curves;
  int colour = black;
  for (const double critical_mm_per_s : critical_velocities_mm_per_s) {
    std::vector<double> x;
    std::vector<double> y;
    for (int i = 0; i <= 80; ++i) {
      x.push_back(2.5 * i);
      y.push_back(per_cent * normal_reduction(x.back(), critical_mm_per_s));
    }
    curves.push_back(
        curve(fmt::format("Vc = {:g} mm/s", critical_mm_per_s), x, y, ++colour, Style::marked));
  }
  curves.push_back(
      curve("measured", {1e3 * dong_velocities_m_per_s[0], 1e3 * dong_velocities_m_per_s[1]},
            {per_cent * dong_reductions[0], per_cent * dong_reductions[1]}, black, Style::points));
  return chart("(d) Normal vibration as large as the indentation", "sliding velocity [mm/s]",
               "reduction of friction [%]", std::move(curves), Key::upper_right, {0.0, 105.0});
}

std::vector<Column> columns(const SlowSliding& slow) {
  std::vector<Column> all = {{"sliding_velocity_mm_per_s", slow.speeds_mm_per_s},
                             {"coulomb_reduction", ends(slow.coulomb, &Interval::least)}};
  const auto add = [&all](const std::string& law, const std::vector<Interval>& ranges) {
    all.push_back({law + "_reduction_from", ends(ranges, &Interval::least)});
    all.push_back({law + "_reduction_to", ends(ranges, &Interval::most)});
  };
  add("dahl", slow.dahl);
  add("lugre", slow.lugre);
  add("stribeck", slow.stribeck);
  return all;
}

}  // namespace sonoglide::paper
