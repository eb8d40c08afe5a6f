/// Sweeps of circuits that are known, with errors of a known kind.
#pragma once

#include <cstdint>
#include <random>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

enum class Error {
  relative,    ///< of equal relative size
  admittance,  ///< of equal size in the admittance
  impedance,   ///< of equal size in the impedance
  correlated,  ///< relative; half of the variance hangs together, by 0.9 from reading to reading
  jitter,      ///< relative, and each frequency is off by 2 % of the band width
};

/// A second mode, at least 2.5 band widths from both resonances.
enum class Second {
  none,
  strong,  ///< a tenth of the first one's conductance: the fit must find it
  weak,    ///< 0.1 to 1 % of it: the fit may miss it
  beside,  ///< a tenth to half of it, 0.3 to 2 % of its frequency above the sweep
};

/// What else a measured sweep has.
enum class Trait {
  none,
  lean,         ///< the resonance falls or rises by 0.05 to 0.5 band widths at the largest current
  phase_error,  ///< every phase is off by 0.5 to 2 degrees
  narrow,       ///< likewise, in a sweep of 3 band widths on either side of the resonance
  delay,        ///< the voltage is read too late or too early by 0.5 to 3 degrees of the resonance
  wide_delay,   ///< likewise; half of the readings are from half the resonance to twice it
  lead_delay,   ///< likewise, behind a resistance of 0.1 R
  lead,         ///< a lead of 0.1 R, whose reactance is up to a hundredth of the capacitance's
  drift,        ///< the resonance falls by 0.1 to 0.3 band widths from first to last reading
};

struct Kind {
  const char* name;
  bool has_phase;
  Error error;
  double loss_tangent;
  Second second;
  Trait trait = Trait::none;
};

/// The published set of a piece at 112.7 kHz: C0 1.53668657 nF, R1 106.327685 ohm, L1 52.6754086 mH,
/// C1 37.8469081 pF.
Circuit published_piece();

/// The middle of published figures of a Langevin transducer at 28.3 kHz (C0 3.1 to 3.35 nF, R1 170 to
/// 179 ohm, L1 70 to 72 mH, C1 0.44 to 0.45 nF, Q 70 to 75): C0 3.2 nF, tan δ 0.004, R1 175 ohm, L1
/// 71 mH, C1 0.445 nF.
Circuit published_langevin();

/// A mode by its elements.
Mode mode_of(double resistance_ohm, double inductance_H, double capacitance_F);

struct Synthetic {
  Circuit truth;
  Sweep sweep;
};

/// A random circuit (fs 20 to 200 kHz, Q 20 to 200, C1/C0 0.01 to 0.1) swept in equal steps across
/// both resonances, with errors of 1 %.
Synthetic synthetic(const Kind& kind, int readings, std::mt19937_64& random);

/// The circuit at even steps, without errors.
Sweep exact_sweep(const Circuit& circuit, double low_Hz, double high_Hz, int readings);

/// Gaussian errors of magnitude and phase, the same for the same seed.
void disturb(Sweep& sweep, double magnitude, double phase_rad, unsigned seed);

}  // namespace sonoglide::identify::impedance
