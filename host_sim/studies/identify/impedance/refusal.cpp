#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <vector>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/studies/identify/impedance/selection.hpp"

namespace sonoglide::identify::impedance {
namespace {

struct Bounds {
  Part part;
  double least;
  double most;
};

bool has_plausible_parts(const Sweep& sweep, const CircuitFit& fit) {
  constexpr double unbounded = 1e300;
  constexpr double most_turn_rad = 0.26;
  const Circuit& circuit = fit.circuit;
  const double resonance_rad_per_s = two_pi * circuit.modes.front().resonance_Hz;
  const Bounds all[] = {
      {Part::loss_tangent, sweep.has_phase ? -unbounded : 0.0, unbounded},
      {Part::rotation, -most_turn_rad, most_turn_rad},
      {Part::delay, -most_turn_rad / resonance_rad_per_s, most_turn_rad / resonance_rad_per_s},
      {Part::lead_resistance, 0.0, 0.25 * circuit.modes.front().resistance_ohm()},
      {Part::lead_inductance, 0.0, most_inductance_H(circuit)},
      {Part::lean, -3.0, 3.0},
  };
  const Eigen::VectorXd p = to_vector(circuit);
  return std::all_of(std::begin(all), std::end(all), [&](const Bounds& each) {
    const double value = p(index_of(each.part));
    return !fit.parts.has(each.part) || (value > each.least && value < each.most);
  });
}

bool is_plausible_inside(const Sweep& sweep, const Mode& mode) {
  constexpr std::ptrdiff_t fewest = 2;
  return mode.bandwidth_Hz < 2.0 * (sweep.frequency_Hz.back() - sweep.frequency_Hz.front()) &&
         mode.quality() > 0.5 &&
         std::count_if(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(), [&](double f) {
           return std::abs(f - mode.resonance_Hz) < mode.bandwidth_Hz;
         }) >= fewest;
}

bool is_plausible_beside(const Sweep& sweep, const Mode& first, const Mode& mode) {
  const double reach_Hz = 0.5 * (sweep.frequency_Hz.back() - sweep.frequency_Hz.front());
  const double quality = mode.quality() / first.quality();
  return mode.resonance_Hz > sweep.frequency_Hz.front() - reach_Hz &&
         mode.resonance_Hz < sweep.frequency_Hz.back() + reach_Hz && quality > 0.25 &&
         quality < 4.0 && mode.conductance_S < 10.0 * first.conductance_S;
}

/// A circuit of one mode is judged where it is refused. To magnitudes alone a lead looks like a mode
/// beside the sweep.
bool has_plausible_modes(const Sweep& sweep, const Circuit& circuit) {
  const std::vector<Mode>& all = circuit.modes;
  const auto inside =
      std::count_if(all.begin(), all.end(), [&](const Mode& mode) { return is_in(sweep, mode); });
  const std::ptrdiff_t most_beside = sweep.has_phase ? 2 : 0;
  return static_cast<std::ptrdiff_t>(all.size()) - inside <= most_beside &&
         std::all_of(all.begin(), all.end(), [&](const Mode& mode) {
           return is_apart(sweep, circuit, mode) &&
                  (is_in(sweep, mode) ? is_plausible_inside(sweep, mode)
                                      : is_plausible_beside(sweep, all.front(), mode));
         });
}

}  // namespace

bool is_in(const Sweep& sweep, const Mode& mode) {
  return mode.resonance_Hz >= sweep.frequency_Hz.front() &&
         mode.resonance_Hz <= sweep.frequency_Hz.back();
}

bool is_apart(const Sweep& sweep, const Circuit& circuit, const Mode& mode) {
  constexpr double bands = 2.0;
  const double widest_Hz = 0.25 * (sweep.frequency_Hz.back() - sweep.frequency_Hz.front());
  return std::all_of(circuit.modes.begin(), circuit.modes.end(), [&](const Mode& other) {
    const Mode& larger = mode.conductance_S > other.conductance_S ? mode : other;
    const double band_Hz = larger.bandwidth_Hz < widest_Hz
                               ? larger.bandwidth_Hz
                               : std::min(mode.bandwidth_Hz, other.bandwidth_Hz);
    return &other == &mode || std::abs(mode.resonance_Hz - other.resonance_Hz) > bands * band_Hz;
  });
}

double most_inductance_H(const Circuit& circuit) {
  constexpr double largest_part = 0.05;
  const double omega = two_pi * circuit.modes.front().resonance_Hz;
  return largest_part / (omega * omega * circuit.clamped_capacitance_F);
}

bool is_plausible(const Sweep& sweep, const CircuitFit& fit) {
  return fit.converged && has_plausible_parts(sweep, fit) &&
         (fit.circuit.modes.size() == 1 || has_plausible_modes(sweep, fit.circuit));
}

namespace {

using Complex = std::complex<double>;

double misfit_of_start(const Sweep& sweep) {
  const std::vector<Start> starts = start_circuits(sweep, 1);
  return starts.empty() ? std::numeric_limits<double>::infinity() : starts.front().misfit;
}

/// What of a sweep with phase may explain a refusal.
std::string explanation(const Sweep& sweep) {
  Sweep conjugate = sweep;
  double resistive = 0.0;  // share of readings with a phase within 10 degrees of 0
  for (Complex& each : conjugate.admittance_S) {
    constexpr double tangent_10_degrees = 0.176;
    resistive += std::abs(each.imag()) < tangent_10_degrees * each.real() ? 1.0 : 0.0;
    each = std::conj(each);
  }
  resistive /= static_cast<double>(sweep.admittance_S.size());
  constexpr double most = 0.8;
  if (resistive > most) {
    return fmt::format(
        ". The phase is within 10 degrees of 0 at {:.0f} % of the readings: they are those of a "
        "resistance",
        100.0 * resistive);
  }
  constexpr double far = 0.1;
  return misfit_of_start(conjugate) < far * misfit_of_start(sweep)
             ? ". With the other sign of the phase a circuit fits far better: is the sign of the "
               "phase or of the imaginary part reversed, is an admittance read as an impedance, or "
               "is the fixture shorted?"
             : "";
}

[[noreturn]] void refuse(const Sweep& sweep, const std::string& reason) {
  throw loop::ComputationError("identify impedance: " + reason +
                               (sweep.has_phase ? explanation(sweep) : ""));
}

/// A capacitance with loss alone, begun where the mean deviation is nothing.
CircuitFit fit_capacitance(const Sweep& sweep) {
  Parts parts = Parts{}.with(Part::loss_tangent, sweep.has_phase);
  parts.modes = 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    sum += std::log(std::abs(sweep.admittance_S[i]) / (two_pi * sweep.frequency_Hz[i]));
  }
  const double capacitance_F = std::exp(sum / static_cast<double>(sweep.frequency_Hz.size()));
  CircuitFit fit = fit_circuit(sweep, parts, {capacitance_F, 0.0, {}}, {});
  constexpr int rounds = 2;
  for (int round = 0; round < rounds && fit.converged; ++round) {
    fit = fit_circuit(sweep, parts, fit.circuit, estimate_noise(fit.at, Correlation::estimated));
  }
  return fit;
}

/// What helps where a sweep has more than one mode.
std::string advice(const CircuitFit& fit) {
  if (fit.parts.modes == 1) {
    return {};
  }
  std::vector<std::string> places;
  for (const Mode& each : fit.circuit.modes) {
    places.push_back(fmt::format("{:.6g}", each.resonance_Hz));
  }
  return fmt::format(
      ". The fit has modes at {} Hz: narrow the sweep to the resonance that is meant and its "
      "antiresonance",
      fmt::join(places, ", "));
}

void require_described(const Sweep& sweep, const Description& description, const char* otherwise,
                       double most) {
  if (description.fails() && description.residual > most) {
    refuse(sweep,
           fmt::format("{}: what is left is {:.3g} % of the readings, root mean square, where "
                       "they scatter by {:.2g} % from one to the next. Narrow the sweep to one "
                       "resonance and its antiresonance",
                       otherwise, 100.0 * description.residual, 100.0 * description.scatter));
  }
}

}  // namespace

void refuse_without_fit(const Sweep& sweep) {
  refuse(sweep, "no circuit fits the sweep: the least squares do not converge from any start");
}

void require_resonance(const Sweep& sweep, const CircuitFit& fit) {
  const CircuitFit none = fit_capacitance(sweep);
  const double places = std::log(static_cast<double>(sweep.frequency_Hz.size()));
  constexpr double half = 0.5;
  const bool explains =
      none.description.fails() &&
      std::pow(fit.description.misfit(), 2) <= half * std::pow(none.description.misfit(), 2);
  if (!none.converged || explains || schwarz(none) > schwarz(fit) + 2.0 * places) {
    return;
  }
  require_described(sweep, none.description,
                    "neither one resonance nor a capacitance alone describes the sweep", 0.0);
  refuse(sweep, fmt::format("no resonance was found from {:.6g} to {:.6g} Hz: a capacitance of "
                            "{:.4g} F alone fits as well",
                            sweep.frequency_Hz.front(), sweep.frequency_Hz.back(),
                            none.circuit.clamped_capacitance_F));
}

void require_inside(const Sweep& sweep, const CircuitFit& fit) {
  const Mode& mode = *std::max_element(
      fit.circuit.modes.begin(), fit.circuit.modes.end(),
      [](const Mode& a, const Mode& b) { return a.conductance_S < b.conductance_S; });
  const double low_Hz = sweep.frequency_Hz.front();
  const double high_Hz = sweep.frequency_Hz.back();
  const std::string bound = "the fit ends at a bound: ";
  if (!is_in(sweep, mode)) {
    constexpr double near = 3.0;
    const bool is_near = mode.resonance_Hz > low_Hz / near && mode.resonance_Hz < high_Hz * near;
    refuse(sweep, fmt::format("{}{} is not in the sweep, which goes from {:.6g} to {:.6g} Hz; "
                              "measure across the resonance",
                              bound,
                              is_near ? fmt::format("its resonance at {:.6g} Hz", mode.resonance_Hz)
                                      : std::string("the resonance"),
                              low_Hz, high_Hz));
  }
  constexpr double least_quality = 0.5;
  if (mode.quality() < least_quality) {
    refuse(sweep, fmt::format("{}a quality factor of {:.3g}, allowed: from {:g}; the sweep does "
                              "not determine the resistance{}",
                              bound, mode.quality(), least_quality, advice(fit)));
  }
  constexpr double most_ratio = 1e3;
  const double ratio = mode.capacitance_F() / fit.circuit.clamped_capacitance_F;
  if (ratio < 1e-9 || ratio > most_ratio) {
    refuse(sweep, fmt::format("{}motional over clamped capacitance of {:.3g}, allowed: 1e-9 to "
                              "{:g}; the sweep does not separate them{}",
                              bound, ratio, most_ratio, advice(fit)));
  }
}

void require_description(const Sweep& sweep, const CircuitFit& fit) {
  require_described(sweep, fit.description, "the circuit does not describe the sweep",
                    most_residual);
}

}  // namespace sonoglide::identify::impedance
