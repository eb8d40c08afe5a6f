#include "host_sim/studies/identify/friction/readings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "firmware/numeric/turn.hpp"
#include "host_sim/scene/bound.hpp"
#include "host_sim/studies/identify/friction/reading_columns.hpp"
#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::identify::friction {
namespace {

/// A vibration is none, or at least this.
constexpr double least_vibration_m_per_s = 1e-15;
/// Values that are all below are no measurement.
constexpr double least_friction = 1e-12;

/// Peak vibration velocities, from whichever column the file has.
std::vector<double> vibrations(const ReadingColumns& columns,
                               const std::vector<double>& sliding_m_per_s,
                               const std::vector<double>& frequency_Hz,
                               const MeasuredTable& table) {
  const std::string_view name =
      columns.one_of({"vibration_velocity_m_per_s", "velocity_ratio", "vibration_amplitude_m"});
  std::vector<double> values = columns.numbers(name);
  const bool as_ratio = name == "velocity_ratio";
  std::vector<double> m_per_s_each(values.size(), 1.0);
  if (as_ratio) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = sliding_m_per_s[i] / values[i];
    }
  } else if (name == "vibration_amplitude_m") {
    if (frequency_Hz.empty()) {
      throw table.heading_error(
          "vibration_amplitude_m gives no velocity alone; allowed: with frequency_Hz");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      m_per_s_each[i] = numeric::two_pi * frequency_Hz[i];
      values[i] *= m_per_s_each[i];
    }
  }
  const auto allowed = [&](std::size_t row) {
    return as_ratio
               ? "at most " + scene::at_most(sliding_m_per_s[row] / least_vibration_m_per_s)
               : "0, or at least " + scene::at_least(least_vibration_m_per_s / m_per_s_each[row]);
  };
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (values[row] > 0.0 && values[row] < least_vibration_m_per_s) {
      throw columns.error(
          row, name,
          fmt::format("is a vibration of {:g} m/s; allowed: {}", values[row], allowed(row)));
    }
  }
  return values;
}

/// What a metal bears: fatigue strength over density and speed of sound, some 600 MPa of titanium.
constexpr double most_of_a_metal_m_per_s = 30.0;

void warn(Readings& readings) {
  const double fastest_m_per_s = std::accumulate(
      readings.rows.begin(), readings.rows.end(), 0.0,
      [](double most, const Reading& row) { return std::max(most, row.vibration_m_per_s); });
  if (fastest_m_per_s > most_of_a_metal_m_per_s) {
    readings.warnings.push_back(
        fmt::format("A vibration of {:g} m/s is faster than a metal bears, some {:g} m/s: is the "
                    "column in m/s, in m and in Hz?",
                    fastest_m_per_s, most_of_a_metal_m_per_s));
  }
  if (readings.are_forces) {
    return;
  }
  const auto outside =
      std::count_if(readings.rows.begin(), readings.rows.end(),
                    [](const auto& row) { return row.friction > 1.0 || row.friction < 0.0; });
  if (outside > 0) {
    readings.warnings.push_back(fmt::format(
        "{} of {} friction ratios are outside of 0 to 1, where no law without a Stribeck curve "
        "has them: by scatter, or by an undriven friction that was not that of the same speed.",
        outside, readings.rows.size()));
  }
}

/// The readings of each sliding velocity, vibration velocity and frequency.
std::map<std::array<double, 3>, std::vector<Reading>> by_velocity(
    const std::vector<Reading>& rows) {
  std::map<std::array<double, 3>, std::vector<Reading>> groups;
  for (const Reading& row : rows) {
    groups[{row.sliding_m_per_s, row.vibration_m_per_s, row.frequency_Hz}].push_back(row);
  }
  return groups;
}

/// The last one that the frictions are written with: a power of ten. That of the largest is one only where
/// several have no other: of two values the zeros behind it may have been left out.
double last_digit(const std::vector<Reading>& rows) {
  double largest = 0.0;
  std::set<double> different;
  for (const Reading& row : rows) {
    largest = std::max(largest, std::abs(row.friction));
    different.insert(row.friction);
  }
  constexpr std::size_t several = 3;
  double digit =
      std::pow(10.0, std::floor(std::log10(largest)) - (different.size() < several ? 1.0 : 0.0));
  const auto is_written_with = [&](const Reading& row) {
    constexpr double of_binary = 1e-13;
    return std::abs(row.friction - std::round(row.friction / digit) * digit) <= of_binary * largest;
  };
  constexpr int most_digits = 17;
  for (int i = 0; i < most_digits && !std::all_of(rows.begin(), rows.end(), is_written_with); ++i) {
    digit /= 10.0;
  }
  return digit;
}

/// The mean of the readings of each velocity; and the scatter about it.
struct Means {
  std::vector<Reading> rows;
  double scatter = 0.0;  ///< standard deviation
};

/// @param rows  some are of one velocity
Means means_of(const std::vector<Reading>& rows) {
  Means means;
  double squares = 0.0;
  for (const auto& [velocity, group] : by_velocity(rows)) {
    const double sum =
        std::accumulate(group.begin(), group.end(), 0.0,
                        [](double all, const Reading& each) { return all + each.friction; });
    Reading mean = group.front();
    mean.friction = sum / static_cast<double>(group.size());
    for (const Reading& each : group) {
      squares += std::pow(each.friction - mean.friction, 2);
    }
    means.rows.push_back(mean);
  }
  means.scatter = std::sqrt(squares / static_cast<double>(rows.size() - means.rows.size()));
  return means;
}

/// Repeats that scatter by less than half a digit are all off by the same rounding, which more of them do not
/// make less. More scatter is rounded up as often as down.
void join_rounded_alike(Readings& readings) {
  constexpr double half = 0.5;
  if (readings.have_standard_errors || readings.distinct() == readings.rows.size()) {
    return;
  }
  Means means = means_of(readings.rows);
  if (means.scatter >= half * readings.last_digit) {
    return;
  }
  if (means.rows.size() == 1) {  // has no scatter to be told from
    readings.rounding *= std::sqrt(static_cast<double>(readings.rows.size()));
    return;
  }
  readings.rows = std::move(means.rows);
  readings.warnings.push_back(fmt::format(
      "Repeated readings scatter by less than half of their last digit, {:g}, so that all of one velocity "
      "are off by the same rounding: their mean counts as one reading.",
      readings.last_digit));
}

}  // namespace

std::size_t Readings::distinct() const {
  return by_velocity(rows).size();
}

Readings read_readings(const scene_file::Source& source) {
  const MeasuredTable table(source, find_table(source, are_names_of_readings));
  if (table.rows() > most_readings) {
    throw table.heading_error(
        fmt::format("{} rows below it; allowed: up to {}, means of readings at one velocity count "
                    "as much",
                    table.rows(), most_readings));
  }
  const ReadingColumns columns(table);
  columns.one_of({"sliding_velocity_m_per_s"});
  const std::string_view friction = columns.one_of({"friction_ratio", "friction_force_N"});
  Readings readings;
  readings.are_forces = friction == "friction_force_N";
  readings.have_frequency = columns.has("frequency_Hz");
  const std::string_view error =
      readings.are_forces ? "friction_force_standard_error_N" : "friction_ratio_standard_error";
  const std::string_view other =
      readings.are_forces ? "friction_ratio_standard_error" : "friction_force_standard_error_N";
  if (columns.has(other)) {
    throw table.heading_error(
        fmt::format("{} does not belong to {}; allowed: {}", other, friction, error));
  }
  readings.have_standard_errors = columns.has(error);
  const std::vector<double> sliding = columns.numbers("sliding_velocity_m_per_s");
  const std::vector<double> frequency =
      readings.have_frequency ? columns.numbers("frequency_Hz") : std::vector<double>();
  const std::vector<double> vibration = vibrations(columns, sliding, frequency, table);
  const std::vector<double> values = columns.numbers(friction);
  const std::vector<double> errors =
      readings.have_standard_errors ? columns.numbers(error) : std::vector<double>();
  if (table.rows() < 2) {
    throw table.heading_error("one row below it; allowed: at least 2");
  }
  if (std::all_of(vibration.begin(), vibration.end(), [](double v) { return v == 0.0; })) {
    throw table.heading_error("no row has a vibration; allowed: at least one");
  }
  const auto is_above = [](double value) { return std::abs(value) > least_friction; };
  if (!(std::accumulate(values.begin(), values.end(), 0.0) > 0.0) ||
      std::none_of(values.begin(), values.end(), is_above)) {
    throw table.heading_error(fmt::format(
        "{} is not above 0 in the mean; allowed: positive against the sliding", friction));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    readings.rows.push_back({sliding[i], vibration[i], readings.have_frequency ? frequency[i] : 0.0,
                             values[i], readings.have_standard_errors ? errors[i] : 0.0});
  }
  readings.last_digit = last_digit(readings.rows);
  readings.rounding = readings.last_digit / std::sqrt(12.0);
  warn(readings);
  join_rounded_alike(readings);
  std::stable_sort(readings.rows.begin(), readings.rows.end(),
                   [](const Reading& a, const Reading& b) {
                     return std::make_tuple(a.velocity_ratio(), a.sliding_m_per_s) <
                            std::make_tuple(b.velocity_ratio(), b.sliding_m_per_s);
                   });
  readings.warnings.insert(readings.warnings.end(), table.warnings().begin(),
                           table.warnings().end());
  return readings;
}

}  // namespace sonoglide::identify::friction
