#include "host_sim/studies/identify/impedance/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "host_sim/studies/identify/impedance/sweep_columns.hpp"
#include "host_sim/studies/identify/text_file.hpp"

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

/// Whether the first readings of the frequencies that have several are off their means alike from one to the
/// next, as those of a trace are. The steps of white noise have twice its mean square.
/// @param off  relative
bool is_of_a_trace(const std::vector<Complex>& off) {
  constexpr std::size_t fewest = 8;
  constexpr double part = 0.5;
  double squares = 0.0;
  double steps = 0.0;
  for (std::size_t i = 1; i < off.size(); ++i) {
    squares += std::norm(off[i]);
    steps += std::norm(off[i] - off[i - 1]);
  }
  return off.size() >= fewest && steps < part * squares;
}

/// By rising frequency, of each the mean of its readings.
void sort_and_average(Sweep& sweep) {
  std::map<double, std::vector<Complex>> readings_S;
  const std::size_t given = sweep.frequency_Hz.size();
  for (std::size_t i = 0; i < given; ++i) {
    readings_S[sweep.frequency_Hz[i]].push_back(sweep.admittance_S[i]);
  }
  sweep.frequency_Hz.clear();
  sweep.admittance_S.clear();
  double difference = 0.0;
  std::vector<Complex> first_off;
  for (const auto& [frequency_Hz, all_S] : readings_S) {
    const Complex sum_S = std::accumulate(all_S.begin(), all_S.end(), Complex(0.0));
    const Complex mean_S = sum_S / static_cast<double>(all_S.size());
    for (const Complex each_S : all_S) {
      difference = std::max(difference, std::abs(each_S / mean_S - 1.0));
    }
    if (all_S.size() > 1) {
      first_off.push_back(all_S.front() / mean_S - 1.0);
    }
    sweep.frequency_Hz.push_back(frequency_Hz);
    sweep.admittance_S.push_back(mean_S);
  }
  const bool of_traces = is_of_a_trace(first_off);
  if (readings_S.size() < given) {
    sweep.warnings.push_back(fmt::format(
        "The file has {} readings at {}: those of one frequency are averaged.{}", given,
        counted_frequencies(readings_S.size()),
        difference > large || of_traces
            ? fmt::format(
                  " They differ by up to {:.2g} % from their mean{}: of several "
                  "traces leave one.",
                  100.0 * difference,
                  of_traces ? ", in the same way along the sweep, which no interval includes" : "")
            : ""));
  }
}

}  // namespace

Sweep read_sweep(const scene_file::Source& source) {
  std::optional<Sweep> found = read_touchstone(source);
  found = found ? found : read_traces(source);
  Sweep sweep = found ? *found : read_table(source);
  sort_and_average(sweep);
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
