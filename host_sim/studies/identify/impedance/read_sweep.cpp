#include "host_sim/studies/identify/impedance/read_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "host_sim/studies/identify/impedance/read_touchstone.hpp"
#include "host_sim/studies/identify/impedance/read_traces.hpp"
#include "host_sim/studies/identify/impedance/sweep_columns.hpp"
#include "host_sim/studies/identify/plain_text.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

/// Few digits are no contradiction.
constexpr double large = 0.05;

std::string counted_frequencies(std::size_t count) {
  return count == 1 ? "1 frequency" : fmt::format("{} frequencies", count);
}

/// Of a second form that the table has, against the one that is read.
void require_agreement(const MeasuredTable& table, const Sweep& other, const SweepColumns& columns,
                       const Sweep& sweep) {
  std::vector<std::size_t> off;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Complex read_S = sweep.admittance_S[row];
    // A phase may be of either form.
    const Complex other_S = other.admittance_S[row];
    const double difference_S = columns.rectangular()
                                    ? std::abs(other_S - read_S)
                                    : std::abs(std::abs(other_S) - std::abs(read_S));
    if (difference_S > large * std::abs(read_S)) {
      off.push_back(row);
    }
  }
  constexpr std::size_t many = 10;
  if (off.size() * many > table.rows()) {
    throw table.error(
        off.front(), columns.first.index,
        fmt::format("contradicts {}, as other rows do; allowed: columns that agree", sweep.format));
  }
}

Sweep read_table(const scene_file::Source& source) {
  const MeasuredTable table(source, find_table(source, are_names_of_a_sweep));
  const FoundColumns found = find_columns(table);
  const SweepColumns& form = found.forms.front();
  Sweep sweep = sweep_of(table, table, found.frequency, form);
  sweep.format = form.description();
  sweep.warnings.insert(sweep.warnings.begin(), found.warnings.begin(), found.warnings.end());
  constexpr double lowest_of_ultrasound_Hz = 1000.0;
  if (!found.frequency.has_unit &&
      *std::max_element(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end()) <
          lowest_of_ultrasound_Hz) {
    sweep.warnings.push_back(
        fmt::format("\"{}\" has no unit in its name: it is taken for a frequency in Hz.",
                    shortened(table.names()[found.frequency.index])));
  }
  for (std::size_t i = 1; i < found.forms.size(); ++i) {
    require_agreement(table, sweep_of(table, table, found.frequency, found.forms[i]),
                      found.forms[i], sweep);
  }
  const bool is_assumed = !form.first.has_unit && form.first.subject != Subject::unknown;
  const char* const unit = form.first.subject == Subject::impedance ? "ohm" : "siemens";
  sweep.format =
      fmt::format("a table of {}{}", sweep.format,
                  is_assumed ? fmt::format(", in {} as its name has no unit", unit) : "");
  return sweep;
}

/// By frequency; readings of one frequency stay in their order.
void sort_by_frequency(Sweep& sweep) {
  std::vector<std::size_t> order(sweep.frequency_Hz.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sweep.frequency_Hz[a] < sweep.frequency_Hz[b];
  });
  std::vector<double> frequency_Hz;
  std::vector<Complex> admittance_S;
  for (const std::size_t each : order) {
    frequency_Hz.push_back(sweep.frequency_Hz[each]);
    admittance_S.push_back(sweep.admittance_S[each]);
  }
  sweep.frequency_Hz = std::move(frequency_Hz);
  sweep.admittance_S = std::move(admittance_S);
}

/// One reading a frequency, the mean of those that a sorted sweep has there.
void average_repeated(Sweep& sweep) {
  const std::size_t given = sweep.frequency_Hz.size();
  std::size_t kept = 0;
  double difference = 0.0;
  for (std::size_t begin = 0, end = 0; begin < given; begin = end) {
    Complex sum = 0.0;
    while (end < given && sweep.frequency_Hz[end] == sweep.frequency_Hz[begin]) {
      sum += sweep.admittance_S[end++];
    }
    const Complex mean_S = sum / static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      difference = std::max(difference, std::abs(sweep.admittance_S[i] / mean_S - 1.0));
    }
    sweep.frequency_Hz[kept] = sweep.frequency_Hz[begin];
    sweep.admittance_S[kept] = mean_S;
    ++kept;
  }
  if (kept < given) {
    sweep.frequency_Hz.resize(kept);
    sweep.admittance_S.resize(kept);
    sweep.warnings.push_back(
        fmt::format("The file has {} readings at {}: those of one frequency are averaged.{}", given,
                    counted_frequencies(kept),
                    difference > large ? fmt::format(" They differ by up to {:.2g} % from their "
                                                     "mean: of several traces leave one.",
                                                     100.0 * difference)
                                       : ""));
  }
}

}  // namespace

Sweep read_sweep(const scene_file::Source& source) {
  Sweep sweep = is_touchstone(source)     ? read_touchstone(source)
                : is_trace_export(source) ? read_traces(source)
                                          : read_table(source);
  if (const std::string cut = warning_of_cut(source); !cut.empty()) {
    sweep.warnings.push_back(cut);
  }
  sort_by_frequency(sweep);
  average_repeated(sweep);
  constexpr std::size_t fewest = 8;
  if (sweep.frequency_Hz.size() < fewest) {
    throw scene_file::SceneError(
        {source.file, 1, 1}, "sweep",
        fmt::format("has readings at {}; allowed: at least {} frequencies",
                    counted_frequencies(sweep.frequency_Hz.size()), fewest));
  }
  return sweep;
}

}  // namespace sonoglide::identify::impedance
