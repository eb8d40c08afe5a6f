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

using Complex = std::complex<double>;

Sweep read_table(const scene_file::Source& source) {
  const MeasuredTable table(source);
  const SweepColumns columns = find_columns(table);
  Sweep sweep;
  sweep.format = fmt::format("a table of {}", columns.description);
  sweep.has_phase = columns.second.has_value();
  const std::vector<double> frequencies = table.numbers(columns.frequency.index);
  const std::vector<double> first = table.numbers(columns.first.index);
  const std::vector<double> second =
      columns.second ? table.numbers(columns.second->index) : std::vector<double>(first.size());
  const double to_radians = columns.phase_scale(second, sweep.warnings);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double frequency_Hz = frequencies[row] * columns.frequency.scale;
    if (frequency_Hz <= 0.0) {
      throw table.error(row, columns.frequency.index, "is no frequency; allowed: above 0");
    }
    const bool polar = !columns.rectangular;
    const double value = columns.first.value(first[row]);
    if (polar && value <= 0.0) {
      throw table.error(row, columns.first.index, "is no magnitude; allowed: above 0");
    }
    const Complex given = polar
                              ? std::polar(value, sweep.has_phase ? second[row] * to_radians : 0.0)
                              : Complex(value, columns.second->value(second[row]));
    const Complex admittance_S = columns.is_admittance ? given : 1.0 / given;
    if (!std::isfinite(std::abs(admittance_S)) || std::abs(admittance_S) == 0.0) {
      throw table.error(row, columns.first.index,
                        "has an admittance of 0 or without end; allowed: one of a capacitance");
    }
    sweep.frequency_Hz.push_back(frequency_Hz);
    sweep.admittance_S.push_back(admittance_S);
  }
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
    sweep.warnings.push_back(fmt::format(
        "The file has {} readings at {} frequencies: those of one frequency are averaged.", given,
        kept));
  }
}

}  // namespace

Sweep read_sweep(const scene_file::Source& source) {
  Sweep sweep = is_touchstone(source)     ? read_touchstone(source)
                : is_trace_export(source) ? read_traces(source)
                                          : read_table(source);
  sort_by_frequency(sweep);
  average_repeated(sweep);
  constexpr std::size_t fewest = 8;
  if (sweep.frequency_Hz.size() < fewest) {
    throw scene_file::SceneError({source.file, 1, 1}, "sweep",
                                 fmt::format("has readings at {} frequencies; allowed: at least {}",
                                             sweep.frequency_Hz.size(), fewest));
  }
  return sweep;
}

}  // namespace sonoglide::identify::impedance
