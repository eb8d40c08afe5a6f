#include "host_sim/report/spectrum.hpp"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::report {
namespace {

std::vector<double> contact_velocity(const loop::Recording& recording, double sign) {
  std::vector<double> velocity(recording.state.size());
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    velocity[i] =
        recording.sliding_velocity_m_per_s[i] + sign * recording.state[i].velocity_m_per_s;
  }
  return velocity;
}

/// Indices i with V(i) <= 0 < V(i+1), the last two; fewer where there are fewer.
std::vector<std::size_t> last_upward_crossings(const std::vector<double>& velocity) {
  std::vector<std::size_t> found;
  for (std::size_t i = velocity.size(); i-- > 1 && found.size() < 2;) {
    if (velocity[i - 1] <= 0.0 && velocity[i] > 0.0) {
      found.push_back(i - 1);
    }
  }
  std::reverse(found.begin(), found.end());
  return found;
}

}  // namespace

HysteresisLoop last_cycle(const loop::Recording& recording, scene::SignConvention convention,
                          std::size_t samples_per_cycle) {
  const double sign = configure::vibration_sign(convention);
  const std::vector<double> velocity = contact_velocity(recording, sign);
  const std::vector<std::size_t> crossings = last_upward_crossings(velocity);
  const bool reverses = crossings.size() == 2;
  const std::size_t samples = velocity.size();
  const std::size_t first =
      reverses ? crossings[0] : samples - std::min(samples, samples_per_cycle + 1);
  const std::size_t last = reverses ? crossings[1] : samples - 1;
  HysteresisLoop loop;
  double travelled_m = 0.0;
  for (std::size_t i = first; i < samples && i <= last; ++i) {
    if (i > first) {
      const double sliding_m =
          0.5 *
          (recording.sliding_velocity_m_per_s[i] + recording.sliding_velocity_m_per_s[i - 1]) *
          (recording.time_s[i] - recording.time_s[i - 1]);
      loop.sliding_m += sliding_m;
      travelled_m += sliding_m + sign * (recording.state[i].displacement_m -
                                         recording.state[i - 1].displacement_m);
    }
    const bool forward = velocity[i] > 0.0 || !reverses || i == first;
    Branch& branch = forward ? loop.forward : loop.backward;
    branch.displacement_m.push_back(travelled_m);
    branch.force_N.push_back(recording.state[i].friction_force_N);
  }
  return loop;
}

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
