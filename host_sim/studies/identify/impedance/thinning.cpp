#include "host_sim/studies/identify/impedance/thinning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/identification.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// The reading of the largest G/f (|Y|/f).
std::size_t largest_reading(const Sweep& sweep) {
  const auto height = [&](std::size_t i) {
    const auto y = sweep.admittance_S[i];
    return (sweep.has_phase ? y.real() : std::abs(y)) / sweep.frequency_Hz[i];
  };
  std::size_t peak = 0;
  for (std::size_t i = 1; i < sweep.frequency_Hz.size(); ++i) {
    peak = height(i) > height(peak) ? i : peak;
  }
  return peak;
}

/// The last reading up to a frequency.
std::size_t reading_at(const Sweep& sweep, double frequency_Hz) {
  const auto& all = sweep.frequency_Hz;
  const auto above = std::upper_bound(all.begin(), all.end(), frequency_Hz);
  return above == all.begin() ? 0 : static_cast<std::size_t>(above - all.begin()) - 1;
}

/// At most most_readings of a longer sweep, evenly, with all readings about one.
Sweep thinned(const Sweep& sweep, std::size_t place) {
  const std::size_t n = sweep.frequency_Hz.size();
  constexpr std::size_t about = most_readings / 3;
  const std::size_t stride = 1 + n / (most_readings - about);
  Sweep left = sweep;
  left.frequency_Hz.clear();
  left.admittance_S.clear();
  for (std::size_t i = 0; i < n; ++i) {
    if (i % stride == 0 || (i + about / 2 >= place && i <= place + about / 2)) {
      left.frequency_Hz.push_back(sweep.frequency_Hz[i]);
      left.admittance_S.push_back(sweep.admittance_S[i]);
    }
  }
  left.warnings.push_back(fmt::format("Of {} readings {} are used: one of {}, and all about {}.", n,
                                      left.frequency_Hz.size(), stride,
                                      shown("_Hz", sweep.frequency_Hz[place])));
  return left;
}

}  // namespace

Selection select_of_any_length(const Sweep& sweep) {
  if (sweep.frequency_Hz.size() <= most_readings) {
    return select_circuit(sweep);
  }
  const std::size_t largest = largest_reading(sweep);
  Selection selected = select_circuit(thinned(sweep, largest));
  const std::size_t resonance = reading_at(sweep, selected.fit.circuit.modes.front().resonance_Hz);
  constexpr std::size_t margin = most_readings / 12;
  const bool is_near = resonance + margin >= largest && largest + margin >= resonance;
  return is_near ? selected : select_circuit(thinned(sweep, resonance));
}

}  // namespace sonoglide::identify::impedance
