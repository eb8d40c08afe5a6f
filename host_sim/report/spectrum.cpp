#include "host_sim/report/spectrum.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>

#include <unsupported/Eigen/FFT>

#include "firmware/numeric/turn.hpp"

namespace sonoglide::report {

Spectrum amplitude_spectrum(const std::vector<double>& samples, double interval_s,
                            double highest_Hz) {
  if (samples.size() < 2) {
    return {};
  }
  const auto count = static_cast<double>(samples.size());
  const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / count;
  std::vector<double> windowed(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double hann = 0.5 * (1.0 - std::cos(numeric::two_pi * static_cast<double>(i) / count));
    windowed[i] = hann * (samples[i] - mean);
  }
  std::vector<std::complex<double>> transform;
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  fft.fwd(transform, windowed);

  constexpr double hann_gain = 0.5;
  Spectrum spectrum;
  for (std::size_t i = 0; i < transform.size(); ++i) {
    const double frequency_Hz = static_cast<double>(i) / (count * interval_s);
    if (frequency_Hz > highest_Hz) {
      break;
    }
    spectrum.frequency_Hz.push_back(frequency_Hz);
    spectrum.amplitude.push_back(2.0 * std::abs(transform[i]) / (hann_gain * count));
  }
  return spectrum;
}

}  // namespace sonoglide::report
