#include "synthetic.hpp"

#include <algorithm>
#include <cmath>

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

/// Errors of a sweep, reading after reading.
class Errors {
 public:
  Errors(const Kind& kind, double typical_S, std::mt19937_64& random)
      : kind_(kind), typical_S_(typical_S), random_(random), slow_(draw()) {}

  Complex disturbed(Complex admittance_S) {
    constexpr double level = 0.01;
    const Complex error = level * next();
    switch (kind_.error) {
      case Error::admittance:
        return admittance_S + typical_S_ * error;
      case Error::impedance:
        return 1.0 / (1.0 / admittance_S + error / typical_S_);
      default:
        return admittance_S * (1.0 + error);
    }
  }

 private:
  Complex draw() { return {normal_(random_), normal_(random_)}; }

  Complex next() {
    if (kind_.error != Error::correlated) {
      return draw();
    }
    constexpr double memory = 0.9;
    slow_ = memory * slow_ + std::sqrt(1.0 - memory * memory) * draw();
    return std::sqrt(0.5) * (slow_ + draw());
  }

  const Kind& kind_;
  double typical_S_;
  std::mt19937_64& random_;
  std::normal_distribution<double> normal_;
  Complex slow_;
};

/// Low and high end of a sweep.
struct Ends {
  double low_Hz;
  double high_Hz;
};

void add_second(const Kind& kind, Ends ends, Circuit& circuit, std::mt19937_64& random) {
  if (kind.second == Second::none) {
    return;
  }
  std::uniform_real_distribution<double> even(0.0, 1.0);
  const Mode first = circuit.modes.front();
  constexpr double apart = 2.5;
  double place_Hz = first.resonance_Hz;
  if (kind.second == Second::beside) {
    place_Hz = ends.high_Hz + first.resonance_Hz * (0.003 + 0.017 * even(random));
  } else {
    while (std::abs(place_Hz - first.resonance_Hz) < apart * first.bandwidth_Hz ||
           std::abs(place_Hz - circuit.antiresonance_Hz()) < apart * first.bandwidth_Hz) {
      place_Hz = ends.low_Hz + (ends.high_Hz - ends.low_Hz) * even(random);
    }
  }
  const double share = kind.second == Second::beside   ? 0.1 + 0.4 * even(random)
                       : kind.second == Second::strong ? 0.1
                                                       : 0.001 * std::pow(10.0, even(random));
  circuit.modes.push_back(
      {share * first.conductance_S, place_Hz, first.bandwidth_Hz * (0.7 + 0.6 * even(random))});
}

void add_trait(const Kind& kind, Circuit& circuit, std::mt19937_64& random) {
  std::uniform_real_distribution<double> even(0.0, 1.0);
  const double sign = even(random) < 0.5 ? -1.0 : 1.0;
  const double share = even(random);
  switch (kind.trait) {
    case Trait::lean:
      circuit.lean = sign * (0.05 + 0.45 * share);
      break;
    case Trait::phase_error:
    case Trait::narrow:
      circuit.rotation_rad = sign * (0.5 + 1.5 * share) / degrees_per_rad;
      break;
    case Trait::lead_delay:
      circuit.lead.resistance_ohm = 0.1 * circuit.modes.front().resistance_ohm();
      [[fallthrough]];
    case Trait::delay:
    case Trait::wide_delay:
      circuit.delay_s = sign * (0.5 + 2.5 * share) / (360.0 * circuit.modes.front().resonance_Hz);
      break;
    case Trait::lead: {
      const double omega = two_pi * circuit.modes.front().resonance_Hz;
      circuit.lead = {0.1 * circuit.modes.front().resistance_ohm(),
                      0.01 * share / (omega * omega * circuit.clamped_capacitance_F)};
      break;
    }
    default:
      break;
  }
}

/// Half of the readings between the ends, half from half the resonance to twice it.
Sweep exact_wide_sweep(const Circuit& circuit, Ends ends, int readings) {
  const double resonance_Hz = circuit.modes.front().resonance_Hz;
  Sweep sweep = exact_sweep(circuit, ends.low_Hz, ends.high_Hz, readings / 2);
  for (const double f :
       exact_sweep(circuit, 0.5 * resonance_Hz, 2.0 * resonance_Hz, readings / 2).frequency_Hz) {
    sweep.frequency_Hz.push_back(f);
  }
  std::sort(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end());
  sweep.admittance_S.clear();
  for (const double f : sweep.frequency_Hz) {
    sweep.admittance_S.push_back(circuit.admittance_S(f));
  }
  return sweep;
}

void drift(Circuit circuit, double by_Hz, Sweep& sweep) {
  const double resonance_Hz = circuit.modes.front().resonance_Hz;
  const auto last = static_cast<double>(sweep.frequency_Hz.size() - 1);
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    // The truth is the resonance in the middle.
    circuit.modes.front().resonance_Hz =
        resonance_Hz + by_Hz * (0.5 - static_cast<double>(i) / last);
    sweep.admittance_S[i] = circuit.admittance_S(sweep.frequency_Hz[i]);
  }
}

}  // namespace

Mode mode_of(double resistance_ohm, double inductance_H, double capacitance_F) {
  return {1.0 / resistance_ohm, 1.0 / (two_pi * std::sqrt(inductance_H * capacitance_F)),
          resistance_ohm / (two_pi * inductance_H)};
}

Circuit published_langevin() {
  return {3.2e-9, 0.004, {mode_of(175.0, 71e-3, 0.445e-9)}};
}

Circuit published_piece() {
  return {1.53668657e-9, 0.0, {mode_of(106.327685, 52.6754086e-3, 37.8469081e-12)}};
}

Sweep exact_sweep(const Circuit& circuit, double low_Hz, double high_Hz, int readings) {
  Sweep sweep{"", {}, {}, true, {}};
  for (int i = 0; i < readings; ++i) {
    const double f = low_Hz + (high_Hz - low_Hz) * i / (readings - 1);
    sweep.frequency_Hz.push_back(f);
    sweep.admittance_S.push_back(circuit.admittance_S(f));
  }
  return sweep;
}

void disturb(Sweep& sweep, double magnitude, double phase_rad, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (Complex& each : sweep.admittance_S) {
    const double louder = 1.0 + magnitude * normal(random);
    each *= std::polar(louder, phase_rad * normal(random));
  }
}

Synthetic synthetic(const Kind& kind, int readings, std::mt19937_64& random) {
  std::uniform_real_distribution<double> even(0.0, 1.0);
  const double resonance_Hz = 20e3 * std::pow(10.0, even(random));
  const double quality = 20.0 * std::pow(10.0, even(random));
  const double clamped_F = 3e-9;
  const double motional_F = clamped_F * 0.01 * std::pow(10.0, even(random));
  const double bandwidth_Hz = resonance_Hz / quality;
  Circuit truth{clamped_F,
                kind.loss_tangent,
                {{two_pi * resonance_Hz * motional_F * quality, resonance_Hz, bandwidth_Hz}}};
  const double parallel_Hz = truth.antiresonance_Hz();
  const double margin_Hz = std::max(6.0 * bandwidth_Hz, 0.3 * (parallel_Hz - resonance_Hz));
  double low_Hz = std::max(resonance_Hz - margin_Hz, 0.3 * resonance_Hz);
  double high_Hz = parallel_Hz + margin_Hz;
  if (kind.trait == Trait::narrow) {
    low_Hz = resonance_Hz - 3.0 * bandwidth_Hz;
    high_Hz = resonance_Hz + 3.0 * bandwidth_Hz;
  }
  Circuit measured = truth;
  add_second(kind, {low_Hz, high_Hz}, measured, random);
  add_trait(kind, measured, random);
  Sweep sweep = kind.trait == Trait::wide_delay
                    ? exact_wide_sweep(measured, {low_Hz, high_Hz}, readings)
                    : exact_sweep(measured, low_Hz, high_Hz, readings);
  if (kind.trait == Trait::drift) {
    drift(measured, bandwidth_Hz * (0.1 + 0.2 * even(random)), sweep);
  }
  if (kind.error == Error::jitter) {
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
      sweep.admittance_S[i] =
          measured.admittance_S(sweep.frequency_Hz[i] + 0.02 * bandwidth_Hz * normal(random));
    }
  }
  Errors errors(kind, std::abs(measured.admittance_S(0.9 * resonance_Hz)), random);
  for (Complex& each : sweep.admittance_S) {
    each = errors.disturbed(each);
    if (!kind.has_phase) {
      each = std::abs(each);
    }
  }
  sweep.has_phase = kind.has_phase;
  return {truth, sweep};
}

}  // namespace sonoglide::identify::impedance
