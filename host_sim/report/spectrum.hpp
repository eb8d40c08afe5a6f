/// What a recording shows: the cycle of its contact, and the spectrum of a signal.
#pragma once

#include <limits>
#include <vector>

#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

// The friction force against the displacement travelled, over one cycle.

/// One monotone branch.
struct Branch {
  std::vector<double> displacement_m;  ///< u = ∫V dt since the cycle began
  std::vector<double> force_N;
};

struct HysteresisLoop {
  Branch forward;          ///< V > 0
  Branch backward;         ///< V < 0; empty where the sliding never reverses
  double sliding_m = 0.0;  ///< ∫Vt dt over the cycle
};

/// The last full cycle of a recording, from one change to V > 0 to the next; where the sliding
/// never reverses, its last `samples_per_cycle` samples as one branch.
HysteresisLoop last_cycle(const loop::Recording& recording, scene::SignConvention convention,
                          std::size_t samples_per_cycle);

struct Spectrum {
  std::vector<double> frequency_Hz;
  std::vector<double> amplitude;  ///< peak amplitude of a sine at that frequency, signal's unit
};

/// Hann-windowed spectrum, from 0 to half the sampling frequency or, if that is lower, the highest
/// one; the mean is taken off first.
/// A sine on a bin shows its peak amplitude, one between two bins at most 1.42 dB less.
/// @param interval_s  time between samples, > 0
/// @return empty for fewer than two samples
Spectrum amplitude_spectrum(const std::vector<double>& samples, double interval_s,
                            double highest_Hz = std::numeric_limits<double>::infinity());

}  // namespace sonoglide::report
