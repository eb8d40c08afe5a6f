#include "host_sim/report/spectrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/common/constants/pi.hpp"

namespace sonoglide::report::spectrum_test {
namespace {

using tests::pi;

/// Samples of a sine whose frequency is given in cycles per record.
std::vector<double> sine(std::size_t samples, double cycles, double amplitude, double phase = 0.3) {
  std::vector<double> values(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    values[i] =
        amplitude *
        std::sin(2.0 * pi * cycles * static_cast<double>(i) / static_cast<double>(samples) + phase);
  }
  return values;
}

double largest(const Spectrum& spectrum) {
  return *std::max_element(spectrum.amplitude.begin(), spectrum.amplitude.end());
}

TEST(SpectrumTest, RunsFromZeroToHalfTheSamplingFrequency) {
  for (const std::size_t samples : {64U, 63U, 60U}) {
    const Spectrum spectrum = amplitude_spectrum(sine(samples, 3.0, 1.0), 1e-6);
    ASSERT_EQ(spectrum.frequency_Hz.size(), samples / 2 + 1);
    ASSERT_EQ(spectrum.amplitude.size(), spectrum.frequency_Hz.size());
    for (std::size_t i = 0; i < spectrum.frequency_Hz.size(); ++i) {
      EXPECT_NEAR(spectrum.frequency_Hz[i],
                  static_cast<double>(i) * 1e6 / static_cast<double>(samples), 1e-6);
    }
  }
}

TEST(SpectrumTest, ASineOnABinShowsItsPeakAmplitudeThereAndHalfOfItBeside) {
  for (const std::size_t samples : {256U, 255U, 1000U, 16384U}) {
    const Spectrum spectrum = amplitude_spectrum(sine(samples, 17.0, 2.5), 1e-6);
    EXPECT_NEAR(spectrum.amplitude[17], 2.5, 1e-12) << samples;
    EXPECT_NEAR(spectrum.amplitude[16], 1.25, 1e-12);
    EXPECT_NEAR(spectrum.amplitude[18], 1.25, 1e-12);
    EXPECT_NEAR(spectrum.amplitude[15], 0.0, 1e-12);
    EXPECT_NEAR(spectrum.amplitude[19], 0.0, 1e-12);
  }
}

TEST(SpectrumTest, ASineBetweenBinsShowsItsAmplitudeWithinTheWindowsScalloping) {
  for (double off = 0.0; off <= 0.5; off += 0.0625) {
    const double shown = largest(amplitude_spectrum(sine(4096, 300.0 + off, 1.0), 1e-6));
    // The Hann window's main lobe, sin(πx)/(πx)/(1 − x²).
    const double lobe = off == 0.0 ? 1.0 : std::sin(pi * off) / (pi * off) / (1.0 - off * off);
    EXPECT_NEAR(shown, lobe, 1e-5) << off;
    EXPECT_GE(20.0 * std::log10(shown), -1.43);
  }
}

TEST(SpectrumTest, TellsTwoTonesApart) {
  std::vector<double> both = sine(2048, 200.0, 1.0);
  const std::vector<double> weak = sine(2048, 210.0, 1e-6, 1.1);
  for (std::size_t i = 0; i < both.size(); ++i) {
    both[i] += weak[i];
  }
  const Spectrum spectrum = amplitude_spectrum(both, 1e-6);
  EXPECT_NEAR(spectrum.amplitude[200], 1.0, 1e-12);
  EXPECT_NEAR(spectrum.amplitude[210], 1e-6, 1e-12);
  EXPECT_LT(spectrum.amplitude[205], 1e-12);
}

TEST(SpectrumTest, TheMeanIsTakenOff) {
  std::vector<double> values = sine(512, 20.0, 1.0);
  for (double& value : values) {
    value += 1000.0;
  }
  const Spectrum spectrum = amplitude_spectrum(values, 1e-6);
  EXPECT_NEAR(spectrum.amplitude[0], 0.0, 1e-10);
  EXPECT_NEAR(spectrum.amplitude[1], 0.0, 1e-10);
  EXPECT_NEAR(spectrum.amplitude[20], 1.0, 1e-10);
  EXPECT_EQ(largest(amplitude_spectrum(std::vector<double>(100, 3.25), 1.0)), 0.0);
}

TEST(SpectrumTest, KeepsThePowerOfTheWindowedSignal) {
  // Parseval: mean (w x)² over the record is the sum over both sides of |X/n|²; the mean of x is 0.
  constexpr std::size_t samples = 1024;
  std::vector<double> values(samples);
  std::uint32_t state = 1;
  double mean = 0.0;
  for (double& value : values) {
    state = state * 1664525U + 1013904223U;
    value = static_cast<double>(state >> 8) / 16777216.0 - 0.5;
    mean += value / static_cast<double>(samples);
  }
  double windowed = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double hann = std::pow(std::sin(pi * static_cast<double>(i) / samples), 2);
    windowed += std::pow(hann * (values[i] - mean), 2) / samples;
  }
  const Spectrum spectrum = amplitude_spectrum(values, 1e-6);
  double power = 0.0;
  for (std::size_t i = 0; i < spectrum.amplitude.size(); ++i) {
    const double one_side =
        0.25 * spectrum.amplitude[i];  // |X|/n: half for the window, half a side
    power += (i == 0 || 2 * i == samples ? 1.0 : 2.0) * one_side * one_side;
  }
  EXPECT_NEAR(power / windowed, 1.0, 1e-12);
}

TEST(SpectrumTest, OfFewerThanTwoSamplesIsEmpty) {
  EXPECT_TRUE(amplitude_spectrum({}, 1.0).amplitude.empty());
  EXPECT_TRUE(amplitude_spectrum({1.0}, 1.0).frequency_Hz.empty());
  EXPECT_EQ(amplitude_spectrum({1.0, 2.0}, 1.0).amplitude.size(), 2U);
}

}  // namespace
}  // namespace sonoglide::report::spectrum_test
