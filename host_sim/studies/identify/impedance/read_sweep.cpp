#include "host_sim/studies/identify/impedance/read_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "host_sim/studies/identify/impedance/read_touchstone.hpp"
#include "host_sim/studies/identify/impedance/read_traces.hpp"
#include "host_sim/studies/identify/impedance/sweep_columns.hpp"
#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::identify::impedance {
namespace {

std::string counted_frequencies(std::size_t count) {
  return count == 1 ? "1 frequency" : fmt::format("{} frequencies", count);
}

using Complex = std::complex<double>;

/// Of a form with phase the admittances, of one without their magnitudes.
std::vector<Complex> admittances_S(const MeasuredTable& table, const SweepColumns& columns,
                                   std::vector<std::string>& warnings) {
  const bool has_phase = columns.second.has_value();
  const std::vector<double> first = table.numbers(columns.first.index);
  const std::vector<double> second =
      has_phase ? table.numbers(columns.second->index) : std::vector<double>(first.size());
  const double to_radians = columns.phase_scale(second, warnings);
  std::vector<Complex> result(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const bool polar = !columns.rectangular;
    const double value = columns.first.value(first[row]);
    if (polar && value <= 0.0) {
      throw table.error(row, columns.first.index, "is no magnitude; allowed: above 0");
    }
    const Complex given = polar ? std::polar(value, has_phase ? second[row] * to_radians : 0.0)
                                : Complex(value, columns.second->value(second[row]));
    result[row] = columns.is_admittance ? given : 1.0 / given;
    if (!std::isfinite(std::abs(result[row])) || std::abs(result[row]) == 0.0) {
      throw table.error(row, columns.first.index,
                        "has an admittance of 0 or without end; allowed: one of a capacitance");
    }
  }
  return result;
}

std::vector<double> frequencies_Hz(const MeasuredTable& table, const NamedColumn& column) {
  std::vector<double> result = table.numbers(column.index);
  for (std::size_t row = 0; row < result.size(); ++row) {
    result[row] *= column.scale;
    if (result[row] <= 0.0) {
      throw table.error(row, column.index, "is no frequency; allowed: above 0");
    }
  }
  return result;
}

/// Of a second form that the table has, against the one that is read. A phase may be of either.
void require_agreement(const MeasuredTable& table, const SweepColumns& other, const Sweep& sweep) {
  std::vector<std::string> ignored;
  const std::vector<Complex> all_S = admittances_S(table, other, ignored);
  std::vector<std::size_t> off;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Complex read_S = sweep.admittance_S[row];
    const double difference_S = sweep.has_phase && other.rectangular
                                    ? std::abs(all_S[row] - read_S)
                                    : std::abs(std::abs(all_S[row]) - std::abs(read_S));
    // Few digits are no contradiction.
    constexpr double large = 0.05;
    if (difference_S > large * std::abs(read_S)) {
      off.push_back(row);
    }
  }
  constexpr std::size_t many = 10;
  if (off.size() * many > table.rows()) {
    throw table.error(
        off.front(), other.first.index,
        fmt::format("contradicts {}, as other rows do; allowed: columns that agree", sweep.format));
  }
}

Sweep read_table(const scene_file::Source& source) {
  const MeasuredTable table(source);
  const std::vector<SweepColumns> forms = find_columns(table);
  const SweepColumns& columns = forms.front();
  Sweep sweep;
  sweep.format = columns.description;
  sweep.has_phase = columns.second.has_value();
  sweep.frequency_Hz = frequencies_Hz(table, columns.frequency);
  sweep.admittance_S = admittances_S(table, columns, sweep.warnings);
  for (std::size_t i = 1; i < forms.size(); ++i) {
    require_agreement(table, forms[i], sweep);
  }
  sweep.format = "a table of " + sweep.format;
  return sweep;
}

/// By frequency; readings of one frequency stay in their order.
void sort_by_frequency(Sweep& sweep) {
  if (std::is_sorted(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end())) {
    return;
  }
  std::vector<std::size_t> order(sweep.frequency_Hz.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sweep.frequency_Hz[a] < sweep.frequency_Hz[b];
  });
  Sweep sorted = sweep;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.frequency_Hz[i] = sweep.frequency_Hz[order[i]];
    sorted.admittance_S[i] = sweep.admittance_S[order[i]];
  }
  sweep = std::move(sorted);
}

/// One reading a frequency, the mean of those that a sorted sweep has there.
void average_repeated(Sweep& sweep) {
  const std::size_t given = sweep.frequency_Hz.size();
  std::size_t kept = 0;
  for (std::size_t begin = 0, end = 0; begin < given; begin = end) {
    Complex sum = 0.0;
    while (end < given && sweep.frequency_Hz[end] == sweep.frequency_Hz[begin]) {
      sum += sweep.admittance_S[end++];
    }
    sweep.frequency_Hz[kept] = sweep.frequency_Hz[begin];
    sweep.admittance_S[kept] = sum / static_cast<double>(end - begin);
    ++kept;
  }
  if (kept < given) {
    sweep.frequency_Hz.resize(kept);
    sweep.admittance_S.resize(kept);
    sweep.warnings.push_back(
        fmt::format("The file has {} readings at {}: those of one frequency are averaged.", given,
                    counted_frequencies(kept)));
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
