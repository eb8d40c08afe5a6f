#include "firmware/control/feedback/adaptive_regulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "scalars.hpp"

namespace sonoglide::control::adaptive_regulator_test {
namespace {

constexpr double gain = 0.2;
constexpr double least_gain = 0.01;
constexpr double shrink = 0.7;
constexpr double growth = 0.1;
constexpr double small_error = 0.0025;  // on base 2
constexpr int patience = 12;
constexpr int delay = 2;

template <class Scalar>
class AdaptiveRegulatorTest : public testing::Test {
 protected:
  using Regulator = AdaptiveRegulator<Scalar, delay>;
  using Integral = IntegralRegulator<Scalar, delay>;

  static typename Regulator::Parameters parameters(double least = least_gain) {
    typename Regulator::Parameters all{};
    all.gain = scaled<Scalar>(gain);
    all.rest_periods = 10;
    all.hold_periods = 4;
    all.delay_periods = delay;
    all.least_gain = scaled<Scalar>(least);
    all.shrink = scaled<Scalar>(shrink);
    all.growth = scaled<Scalar>(growth);
    all.small_error = scaled<Scalar>(small_error);
    all.patience = patience;
    return all;
  }

  static constexpr double target = 0.25;

  static Regulator regulator() {
    Regulator result(parameters());
    result.restart(scaled<Scalar>(target));
    for (int i = 0; i < 4; ++i) {
      meet(result, 0.0);  // held
    }
    return result;
  }

  /// A period with this error.
  static void meet(Regulator& regulator, double error) {
    regulator.propose(scaled<Scalar>(target), scaled<Scalar>(target - error));
    regulator.accept(false, false);
  }

  static double gain_of(const Regulator& regulator) { return numeric::to_real(regulator.gain()); }

  /// Products in Q15 lose up to two of its units each time.
  static constexpr double tolerance = 4e-4;
};
TYPED_TEST_SUITE(AdaptiveRegulatorTest, Scalars);

TYPED_TEST(AdaptiveRegulatorTest, LowersItsGainAtEachSwingDownToTheLeast) {
  auto regulator = this->regulator();
  double expected = gain;
  for (int swing = 0; swing < 20; ++swing) {
    EXPECT_NEAR(this->gain_of(regulator), expected, this->tolerance) << swing;
    if (swing == 0) {
      this->meet(regulator, 0.01);
    }
    this->meet(regulator, swing % 2 == 0 ? -0.01 : 0.01);
    expected = std::max(least_gain, shrink * expected);
  }
  EXPECT_EQ(regulator.gain(), scaled<TypeParam>(least_gain));
}

TYPED_TEST(AdaptiveRegulatorTest, HasTheWholeGainAgainSoonAfterAnErrorThatLasts) {
  auto regulator = this->regulator();
  for (int i = 0; i < 40; ++i) {
    this->meet(regulator, i % 2 == 0 ? -0.01 : 0.01);
  }
  const int grows = static_cast<int>(std::ceil(std::log(gain / least_gain) / std::log1p(growth)));
  int periods = 0;
  while (this->gain_of(regulator) < gain - 1e-9 && periods < 200) {
    this->meet(regulator, 0.01);
    ++periods;
  }
  EXPECT_GE(periods, patience + 1);
  EXPECT_LE(periods, patience + 1 + grows + 4);  // four more for what Q15 loses
  EXPECT_EQ(regulator.gain(), scaled<TypeParam>(gain));
}

TYPED_TEST(AdaptiveRegulatorTest, CountsNoSmallErrorAndNoneOfAHeldIntegral) {
  auto regulator = this->regulator();
  for (int i = 0; i < 40; ++i) {
    this->meet(regulator, i % 2 == 0 ? -0.9 * small_error : 0.9 * small_error);
  }
  for (int i = 0; i < 40; ++i) {
    regulator.hold();
    this->meet(regulator, i % 2 == 0 ? -0.01 : 0.01);
  }
  EXPECT_EQ(regulator.gain(), scaled<TypeParam>(gain));
}

TYPED_TEST(AdaptiveRegulatorTest, HasTheWholeGainForAnotherTarget) {
  auto regulator = this->regulator();
  for (int i = 0; i < 40; ++i) {
    this->meet(regulator, i % 2 == 0 ? -0.01 : 0.01);
  }
  ASSERT_EQ(regulator.gain(), scaled<TypeParam>(least_gain));
  regulator.target_changes(scaled<TypeParam>(0.001));  // small: it holds nothing
  EXPECT_EQ(regulator.gain(), scaled<TypeParam>(least_gain));
  regulator.target_changes(scaled<TypeParam>(0.1));
  EXPECT_EQ(regulator.gain(), scaled<TypeParam>(gain));
}

double largest_late_error(const std::vector<double>& ratios) {
  double largest = 0.0;
  for (std::size_t i = ratios.size() - 100; i < ratios.size(); ++i) {
    largest = std::max(largest, std::abs(ratios[i] - 0.25));
  }
  return largest;
}

/// A plant whose ratio answers the command after the delay, so many times as steeply as the map tells.
template <class Regulator, class Scalar>
std::vector<double> steep_loop(Regulator regulator, double steepness) {
  regulator.restart(scaled<Scalar>(0.25));
  std::vector<double> commands(delay, 0.25);
  std::vector<double> ratios;
  for (int i = 0; i < 400; ++i) {
    const double ratio =
        std::clamp(0.28 + steepness * (commands[commands.size() - delay] - 0.25), 0.1, 0.4);
    ratios.push_back(ratio);
    commands.push_back(
        numeric::to_real(regulator.propose(scaled<Scalar>(0.25), scaled<Scalar>(ratio))));
    regulator.accept(false, false);
  }
  return ratios;
}

TYPED_TEST(AdaptiveRegulatorTest, IsLikeNewAfterARestart) {
  auto regulator = this->regulator();
  for (int i = 0; i < 40; ++i) {
    this->meet(regulator, i % 2 == 0 ? -0.01 : 0.01);
  }
  EXPECT_EQ(regulator.gain(), scaled<TypeParam>(least_gain));
  regulator.restart(scaled<TypeParam>(this->target));
  EXPECT_EQ(regulator.gain(), scaled<TypeParam>(gain));
  for (int i = 0; i < 4; ++i) {
    this->meet(regulator, 0.0);  // held
  }
  this->meet(regulator, -0.01);  // the error before was above 0, but of another run
  EXPECT_EQ(regulator.gain(), scaled<TypeParam>(gain));
}

TYPED_TEST(AdaptiveRegulatorTest, SettlesWhereThePlantIsTooSteepForTheWholeGain) {
  using Own = AdaptiveRegulatorTest<TypeParam>;
  // An integrator I' = I - g I of D periods before oscillates from a gain of 2 sin(pi/(4 D + 2)) on.
  const double limit = 2.0 * std::sin(3.141592653589793 / (4.0 * (delay - 1) + 2.0)) / gain;
  for (const double steepness : {1.2 * limit, 2.0 * limit, 4.0 * limit}) {
    const auto fixed = steep_loop<typename Own::Integral, TypeParam>(
        typename Own::Integral(Own::parameters()), steepness);
    const auto adaptive = steep_loop<typename Own::Regulator, TypeParam>(
        typename Own::Regulator(Own::parameters()), steepness);
    EXPECT_GT(largest_late_error(fixed), 0.05) << steepness;
    EXPECT_LT(largest_late_error(adaptive), 1.2 * small_error + 1e-3) << steepness;
  }
}

TYPED_TEST(AdaptiveRegulatorTest, IsAnIntegralRegulatorWhereTheLeastGainIsTheGain) {
  using Own = AdaptiveRegulatorTest<TypeParam>;
  std::mt19937 generator(34);
  std::uniform_real_distribution<double> part(-0.1, 0.1);
  typename Own::Regulator adaptive(Own::parameters(gain));
  typename Own::Integral fixed(Own::parameters());
  double asked = 0.25;
  double commanded = asked;
  adaptive.restart(scaled<TypeParam>(asked));
  fixed.restart(scaled<TypeParam>(asked));
  for (int i = 0; i < 5000; ++i) {
    if (i % 50 == 49) {
      const double next = 0.25 + part(generator);
      adaptive.target_changes(scaled<TypeParam>(next - asked));
      fixed.target_changes(scaled<TypeParam>(next - asked));
      asked = next;
    }
    const auto measured = scaled<TypeParam>(std::clamp(commanded + part(generator), 0.0, 0.5));
    const TypeParam ratio = adaptive.propose(scaled<TypeParam>(asked), measured);
    ASSERT_EQ(ratio, fixed.propose(scaled<TypeParam>(asked), measured)) << i;
    commanded = numeric::to_real(ratio);
    const bool at_most = i % 7 == 0;
    const bool at_least = i % 11 == 0;
    adaptive.accept(at_most, at_least);
    fixed.accept(at_most, at_least);
  }
}

/// The law, told by the runs of errors that count: of one sign, one after the other.
TEST(AdaptiveRegulatorLawTest, HoldsForRandomErrors) {
  AdaptiveRegulator<double, 1>::Parameters parameters{};
  parameters.gain = gain;
  parameters.delay_periods = 1;
  parameters.least_gain = least_gain;
  parameters.shrink = shrink;
  parameters.growth = growth;
  parameters.small_error = small_error;
  parameters.patience = patience;
  AdaptiveRegulator<double, 1> regulator(parameters);
  regulator.restart(0.25);
  std::mt19937 generator(43);
  std::normal_distribution<double> noise(0.0, 0.01);
  double expected = gain;
  bool first_run = true;
  int run = 0;
  bool above = false;
  int swings = 0;
  int grown = 0;
  for (int i = 0; i < 20000; ++i) {
    const double error = (i / 100 % 2 == 0 ? 0.0 : 0.03) + noise(generator);
    const double measured = 0.25 - error;
    regulator.propose(0.25, measured);
    regulator.accept(false, false);
    if (std::abs(0.25 - measured) > small_error) {
      const bool swing = run > 0 && above != (error > 0.0);
      first_run = first_run && !swing;
      run = swing ? 1 : run + 1;
      above = error > 0.0;
      swings += swing ? 1 : 0;
      if (swing) {
        expected = std::max(least_gain, shrink * expected);
      } else if (run > patience + (first_run ? 0 : 1)) {
        expected = std::min(gain, expected + growth * expected);
        ++grown;
      }
    }
    ASSERT_NEAR(regulator.gain(), expected, 1e-15) << i;
  }
  EXPECT_GT(swings, 1000);
  EXPECT_GT(grown, 1000);
}

}  // namespace
}  // namespace sonoglide::control::adaptive_regulator_test
