#include "firmware/control/limits/notch_shaper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scalars.hpp"
#include "tests/common/constants/table_1_numbers.hpp"

namespace sonoglide::control::notch_shaper_test {
namespace {

constexpr int max_spacing = 32;

/// A natural mode over one carrier period.
struct Mode {
  double decay;     ///< exp(−σT)
  double rotation;  ///< ωd T
};

std::array<double, 3> notch(const Mode& mode, int spacing) {
  const double decay = std::pow(mode.decay, spacing);
  const double middle = -2.0 * decay * std::cos(mode.rotation * spacing);
  const double sum = 1.0 + middle + decay * decay;
  return {1.0 / sum, middle / sum, decay * decay / sum};
}

/// A mode whose notch at this spacing has every tap within ±1.
Mode mode_for(int spacing, double decay) {
  constexpr double one_notch_rotation = 1.8;
  return {std::pow(decay, 1.0 / spacing), one_notch_rotation / spacing};
}

template <class Scalar>
NotchShaper<Scalar, max_spacing> shaper(const std::array<double, 3>& taps, int spacing) {
  return NotchShaper<Scalar, max_spacing>(
      {{scaled<Scalar>(taps[0]), scaled<Scalar>(taps[1]), scaled<Scalar>(taps[2])},
       static_cast<std::uint8_t>(spacing)});
}

/// Free response of the mode, of unit size for a unit step, after these amplitudes.
std::complex<double> free_response(const std::vector<double>& amplitudes, const Mode& mode) {
  const std::complex<double> turn = std::polar(mode.decay, mode.rotation);
  std::complex<double> state = 0.0;
  double previous = 0.0;
  for (const double amplitude : amplitudes) {
    state = turn * state + (amplitude - previous);
    previous = amplitude;
  }
  return state;
}

template <class Scalar>
class NotchShaperTest : public testing::Test {};
TYPED_TEST_SUITE(NotchShaperTest, Scalars);

/// Bit for bit, the errors of Q15 included, also from a restart on.
template <class Scalar, std::size_t Taps>
void expect_the_line_for_spacing_1_to_agree(const std::array<double, Taps>& taps) {
  std::array<Scalar, Taps> rounded{};
  std::transform(taps.begin(), taps.end(), rounded.begin(),
                 [](double tap) { return scaled<Scalar>(tap); });
  NotchShaper<Scalar, 1, Taps> one({rounded, 1});
  NotchShaper<Scalar, max_spacing, Taps> longer({rounded, 1});
  for (int k = 0; k < 1000; ++k) {
    if (k == 500) {
      one.restart();
      longer.restart();
    }
    const auto amplitude = scaled<Scalar>(0.4 + 0.3 * std::sin(0.7 * k));
    ASSERT_EQ(numeric::to_real(one.shape(amplitude)), numeric::to_real(longer.shape(amplitude)))
        << k;
  }
}

TYPED_TEST(NotchShaperTest, ALineForSpacing1AnswersAsALongerOne) {
  expect_the_line_for_spacing_1_to_agree<TypeParam, 3>(notch(mode_for(1, 0.9), 1));
  expect_the_line_for_spacing_1_to_agree<TypeParam, 5>({0.4, 0.15, 0.2, 0.15, 0.1});
}

TYPED_TEST(NotchShaperTest, AnswersAnImpulseByItsTapsAtEverySpacing) {
  for (int spacing = 1; spacing <= max_spacing; ++spacing) {
    const auto taps = notch(mode_for(spacing, 0.9), spacing);
    auto notching = shaper<TypeParam>(taps, spacing);
    for (int k = 0; k <= 3 * spacing; ++k) {
      const auto shaped = notching.shape(scaled<TypeParam>(k == 0 ? 0.5 : 0.0));
      const bool on_tap = k % spacing == 0 && k <= 2 * spacing;
      const double tap = on_tap ? taps[static_cast<std::size_t>(k / spacing)] : 0.0;
      ASSERT_NEAR(numeric::to_real(shaped), 0.5 * tap, on_tap ? resolution<TypeParam>() : 0.0)
          << "spacing " << spacing << " period " << k;
    }
  }
}

TYPED_TEST(NotchShaperTest, PassesAConstantUnchanged) {
  for (int spacing = 1; spacing <= max_spacing; ++spacing) {
    auto notching = shaper<TypeParam>(notch(mode_for(spacing, 1.0), spacing), spacing);
    for (int k = 0; k < 2 * spacing; ++k) {
      notching.shape(scaled<TypeParam>(0.7));
    }
    ASSERT_NEAR(numeric::to_real(notching.shape(scaled<TypeParam>(0.7))), 0.7,
                3.0 * resolution<TypeParam>());
  }
}

// Rounding of taps and sums excites the mode by some units; without the notch it is by the steps.
TYPED_TEST(NotchShaperTest, LeavesTheModeAtRestAfterTheLastStep) {
  for (const double decay : {1.0, 0.8, 0.4}) {
    for (int spacing = 1; spacing <= max_spacing; ++spacing) {
      const Mode mode = mode_for(spacing, decay);
      auto notching = shaper<TypeParam>(notch(mode, spacing), spacing);
      std::vector<double> unshaped;
      std::vector<double> shaped;
      for (int k = 0; k <= 5 * spacing + 7; ++k) {
        const double amplitude = k < 3 ? 0.3 : k < 2 * spacing + 5 ? 0.55 : 0.4;
        unshaped.push_back(amplitude);
        shaped.push_back(numeric::to_real(notching.shape(scaled<TypeParam>(amplitude))));
      }
      const double allowed =
          std::is_same_v<TypeParam, double> ? 1e-12 : 60 * resolution<TypeParam>();
      ASSERT_LT(std::abs(free_response(shaped, mode)), allowed)
          << "decay " << decay << " spacing " << spacing;
      if (decay == 1.0) {
        ASSERT_GT(std::abs(free_response(unshaped, mode)), 0.05);
      }
    }
  }
}

TYPED_TEST(NotchShaperTest, LeavesTheModeOfTable1AtRestAfterFiveCarrierPeriods) {
  using tests::Table1;
  const Mode mode{1.0, std::sqrt(Table1::stiffness_N_per_m / Table1::mass_kg) / Table1::carrier_Hz};
  auto notching = shaper<TypeParam>(notch(mode, 1), 1);
  std::vector<double> shaped;
  for (int k = 0; k < 5; ++k) {
    shaped.push_back(numeric::to_real(notching.shape(scaled<TypeParam>(0.8))));
  }
  EXPECT_LT(std::abs(free_response(shaped, mode)), 10.0 * resolution<TypeParam>());
}

TYPED_TEST(NotchShaperTest, ARestartForgets) {
  const auto taps = notch(mode_for(3, 0.9), 3);
  auto used = shaper<TypeParam>(taps, 3);
  for (int k = 0; k < 17; ++k) {
    used.shape(scaled<TypeParam>(0.05 * k));
  }
  used.restart();
  auto fresh = shaper<TypeParam>(taps, 3);
  for (int k = 0; k < 17; ++k) {
    const auto amplitude = scaled<TypeParam>(0.8 - 0.04 * k);
    ASSERT_EQ(used.shape(amplitude), fresh.shape(amplitude));
  }
}

TYPED_TEST(NotchShaperTest, NoShapingIsTheIdentity) {
  NoShaping<TypeParam> none({});
  EXPECT_EQ(numeric::to_real(none.shape(scaled<TypeParam>(0.625))), 0.625);
}

/// Two notches in a row, on a mode a little slower and a little faster.
std::array<double, 5> split_notch(const Mode& mode, int spacing, double off) {
  const auto a = notch({mode.decay, mode.rotation * (1.0 - off)}, spacing);
  const auto b = notch({mode.decay, mode.rotation * (1.0 + off)}, spacing);
  return {a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[0] * b[2] + a[1] * b[1] + a[2] * b[0],
          a[1] * b[2] + a[2] * b[1], a[2] * b[2]};
}

constexpr int max_robust_spacing = 16;

template <class Scalar>
NotchShaper<Scalar, max_robust_spacing, 5> shaper(const std::array<double, 5>& taps, int spacing) {
  return NotchShaper<Scalar, max_robust_spacing, 5>(
      {{scaled<Scalar>(taps[0]), scaled<Scalar>(taps[1]), scaled<Scalar>(taps[2]),
        scaled<Scalar>(taps[3]), scaled<Scalar>(taps[4])},
       static_cast<std::uint8_t>(spacing)});
}

TYPED_TEST(NotchShaperTest, FiveTapsAnswerAnImpulseAtEverySpacing) {
  for (int spacing = 1; spacing <= max_robust_spacing; ++spacing) {
    const auto taps = split_notch(mode_for(spacing, 0.9), spacing, 0.1);
    auto notching = shaper<TypeParam>(taps, spacing);
    for (int k = 0; k <= 9 * spacing; ++k) {
      const auto shaped = notching.shape(scaled<TypeParam>(k == 0 ? 0.5 : 0.0));
      const bool on_tap = k % spacing == 0 && k <= 4 * spacing;
      const double tap = on_tap ? taps[static_cast<std::size_t>(k / spacing)] : 0.0;
      ASSERT_NEAR(numeric::to_real(shaped), 0.5 * tap, on_tap ? resolution<TypeParam>() : 0.0)
          << "spacing " << spacing << " period " << k;
    }
  }
}

TYPED_TEST(NotchShaperTest, FiveTapsLeaveEitherModeAtRest) {
  for (int spacing = 1; spacing <= max_robust_spacing; ++spacing) {
    const Mode mode = mode_for(spacing, 1.0);
    for (const double off : {-0.1, 0.1}) {
      auto notching = shaper<TypeParam>(split_notch(mode, spacing, 0.1), spacing);
      std::vector<double> shaped;
      for (int k = 0; k <= 9 * spacing + 7; ++k) {
        const double amplitude = k < 3 ? 0.3 : k < 4 * spacing + 5 ? 0.55 : 0.4;
        shaped.push_back(numeric::to_real(notching.shape(scaled<TypeParam>(amplitude))));
      }
      const double allowed =
          std::is_same_v<TypeParam, double> ? 1e-12 : 100 * resolution<TypeParam>();
      ASSERT_LT(std::abs(free_response(shaped, {1.0, mode.rotation * (1.0 + off)})), allowed)
          << "spacing " << spacing;
    }
  }
}

TYPED_TEST(NotchShaperTest, FiveTapsForgetAtARestart) {
  const auto taps = split_notch(mode_for(3, 0.9), 3, 0.1);
  auto used = shaper<TypeParam>(taps, 3);
  for (int k = 0; k < 17; ++k) {
    used.shape(scaled<TypeParam>(0.05 * k));
  }
  used.restart();
  auto fresh = shaper<TypeParam>(taps, 3);
  for (int k = 0; k < 27; ++k) {
    const auto amplitude = scaled<TypeParam>(0.8 - 0.02 * k);
    ASSERT_EQ(used.shape(amplitude), fresh.shape(amplitude));
  }
}

/// Largest free response of the mode to the rounding of a shaper that is fed amplitudes which
/// wander by a few codes of 16 bits, in those codes.
template <std::size_t TapCount>
double stirred_codes(const Mode& mode, const std::array<double, TapCount>& taps, int spacing) {
  using Short = numeric::Q15<numeric::Trapping>;
  auto notching = shaper<Short>(taps, spacing);
  auto exact = shaper<double>(taps, spacing);
  const std::complex<double> turn = std::polar(mode.decay, mode.rotation);
  std::complex<double> state = 0.0;
  double previous = 0.0;
  double largest = 0.0;
  std::uint32_t random = 1;
  for (int i = 0; i < 100'000; ++i) {
    random = 1664525U * random + 1013904223U;
    const auto amplitude = Short::from_raw(static_cast<std::int16_t>(16000 + (random >> 30)));
    const double rounding =
        numeric::to_real(notching.shape(amplitude)) - exact.shape(numeric::to_real(amplitude));
    state = turn * state + (rounding - previous);
    previous = rounding;
    largest = std::max(largest, std::abs(state));
  }
  return largest * 0x1p15;
}

// Errors of half a code at random add up to a hundred codes.
TEST(NotchRoundingTest, SixteenBitsLeaveAnUndampedModeAlone) {
  for (const int spacing : {1, 2, 5, max_spacing}) {
    const Mode mode = mode_for(spacing, 1.0);
    EXPECT_LT(stirred_codes(mode, notch(mode, spacing), spacing), 4.0) << spacing;
  }
}

TEST(NotchRoundingTest, SixteenBitsLeaveTheModesOnTheZerosOfFiveTapsAlone) {
  for (const int spacing : {1, 2, 5, max_robust_spacing}) {
    const Mode mode = mode_for(spacing, 1.0);
    const auto taps = split_notch(mode, spacing, 0.1);
    for (const double off : {-0.1, 0.1}) {
      EXPECT_LT(stirred_codes({1.0, mode.rotation * (1.0 + off)}, taps, spacing), 8.0) << spacing;
    }
  }
}

// The sanitizers stop the program where a sum overflows.
TEST(NotchRoundingTest, SixteenBitSumsOfFiveTapsFit32Bits) {
  for (const double rotation : {1.35, 2.0, 3.14}) {
    using Short = numeric::Q15<numeric::Saturating>;
    const auto taps = split_notch({1.0, rotation}, 1, 0.0);
    auto notching = shaper<Short>(taps, 1);
    double rose = 0.0;
    double fell = 0.0;
    for (int k = 0; k < 1000; ++k) {
      const bool up = taps[static_cast<std::size_t>(4 - k % 5)] > 0.0;
      const double shaped =
          numeric::to_real(notching.shape(up ? Short::largest() : scaled<Short>(0.0)));
      rose = std::max(rose, shaped);
      fell = std::min(fell, shaped);
    }
    EXPECT_GT(rose, 0.9);
    EXPECT_GT(fell, -0.96);
  }
}

}  // namespace
}  // namespace sonoglide::control::notch_shaper_test
