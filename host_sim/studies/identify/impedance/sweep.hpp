/// A measured sweep of an impedance, whatever file it comes from.
#pragma once

#include <complex>
#include <string>
#include <vector>

namespace sonoglide::identify::impedance {

/// Of an admittance, over rising frequencies. Of a file of magnitudes alone the values are real and
/// positive.
struct Sweep {
  std::string format;  ///< what the file was taken for, in words
  std::vector<double> frequency_Hz;
  std::vector<std::complex<double>> admittance_S;
  bool has_phase = false;
  std::vector<std::string> warnings;  ///< what was assumed, each a sentence
};

}  // namespace sonoglide::identify::impedance
