#include "host_sim/studies/paper/measurements.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

#include "host_sim/output/number.hpp"
#include "host_sim/studies/paper/experiments.hpp"

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

}  // namespace sonoglide::paper
