#include "host_sim/studies/identify/impedance/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/identification.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Place = std::ptrdiff_t;

/// Of the largest G/f (|Y|/f).
Place largest_reading(const Sweep& sweep) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    const auto y = sweep.admittance_S[i];
    heights.push_back((sweep.has_phase ? y.real() : std::abs(y)) / sweep.frequency_Hz[i]);
  }
  return std::max_element(heights.begin(), heights.end()) - heights.begin();
}

/// At most most_readings of a longer sweep, evenly, with all readings about one.
Sweep thinned(const Sweep& sweep, Place place) {
  const auto n = static_cast<Place>(sweep.frequency_Hz.size());
  constexpr auto about = static_cast<Place>(most_readings / 3);
  const Place stride = 1 + n / (static_cast<Place>(most_readings) - about);
  Sweep left{sweep.format, {}, {}, sweep.has_phase, sweep.warnings};
  for (Place i = 0; i < n; ++i) {
    if (i % stride == 0 || std::abs(i - place) <= about / 2) {
      left.frequency_Hz.push_back(sweep.frequency_Hz[static_cast<std::size_t>(i)]);
      left.admittance_S.push_back(sweep.admittance_S[static_cast<std::size_t>(i)]);
    }
  }
  left.warnings.push_back(fmt::format(
      "Of {} readings {} are used: one of {}, and all about {}.", n, left.frequency_Hz.size(),
      stride, formatted("_Hz", sweep.frequency_Hz[static_cast<std::size_t>(place)])));
  return left;
}

}  // namespace

Selection select_of_any_length(const Sweep& sweep) {
  const std::vector<double>& all = sweep.frequency_Hz;
  if (all.size() <= most_readings) {
    return select_circuit(sweep);
  }
  const Place largest = largest_reading(sweep);
  Selection selected = select_circuit(thinned(sweep, largest));
  const Place resonance = std::lower_bound(all.begin(), all.end() - 1,
                                           selected.fit.circuit.modes.front().resonance_Hz) -
                          all.begin();
  constexpr auto margin = static_cast<Place>(most_readings / 12);
  return std::abs(resonance - largest) <= margin ? selected
                                                 : select_circuit(thinned(sweep, resonance));
}

}  // namespace sonoglide::identify::impedance
