/// Amplitude spectrum of a uniformly sampled signal.
#pragma once

#include <limits>
#include <vector>

namespace sonoglide::report {

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
