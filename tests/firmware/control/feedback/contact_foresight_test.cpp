#include "firmware/control/feedback/contact_foresight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware/control/feedback/adaptive_regulator.hpp"
#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/limits/stuck_detector.hpp"
#include "scalars.hpp"

namespace sonoglide::control::contact_foresight_test {
namespace {

constexpr int delay = 2;
constexpr double presliding_periods = 20.0;
constexpr int hold = 72;  // delay and settling of the contact, as designed
constexpr double least_ratio = 0.15;

template <class Scalar>
class ContactForesightTest : public testing::Test {
 protected:
  using Integral = IntegralRegulator<Scalar, delay>;
  using Adaptive = AdaptiveRegulator<Scalar, delay>;
  using Foreseen = ContactForesight<Integral>;

  static typename Integral::Parameters integral() {
    typename Integral::Parameters all{};
    all.gain = scaled<Scalar>(0.1);
    all.hold_periods = hold;
    all.rest_periods = hold;
    all.delay_periods = delay;
    return all;
  }
  static typename Adaptive::Parameters adaptive() {
    return {integral(),          scaled<Scalar>(0.005), scaled<Scalar>(0.7),
            scaled<Scalar>(0.1), scaled<Scalar>(1e-3),  12};
  }
  template <class Regulator>
  static typename ContactForesight<Regulator>::Parameters around(
      const typename Regulator::Parameters& regulator) {
    const numeric::Split<double> presliding = numeric::split(presliding_periods / 8.0);
    return {regulator,
            scaled<Scalar>(1.0 / presliding_periods),
            scaled<Scalar>(std::min(0.25, 1.0 / (presliding_periods * least_ratio))),
            scaled<Scalar>(0.5 * least_ratio),
            {scaled<Scalar>(presliding.mantissa), presliding.exponent}};
  }
  static Foreseen foreseen() { return Foreseen(around<Integral>(integral())); }
};
TYPED_TEST_SUITE(ContactForesightTest, Scalars);

struct Step {
  double from;
  double to;
};
constexpr Step steps[] = {{0.9, 0.4}, {0.6, 0.3}, {0.3, 0.8}, {0.5, 0.45}};

/// The contact by its own equation over a period, whose solution is an exponential.
double followed(double ratio, double commanded, double periods) {
  return commanded + (ratio - commanded) * std::exp(-1.0 / (commanded * periods));
}

template <class Scalar, class Regulator>
double propose(Regulator& regulator, double target, double measured) {
  return 2.0 * numeric::to_real(
                   regulator.propose(scaled<Scalar>(0.5 * target), scaled<Scalar>(0.5 * measured)));
}

template <class Scalar, class Regulator>
void begin(Regulator& regulator, double from, double to) {
  regulator.restart(scaled<Scalar>(0.5 * from));
  regulator.target_changes(scaled<Scalar>(0.5 * (to - from)));
}

TYPED_TEST(ContactForesightTest, MovesTheContactByAQuarterOfTheRestWhereTheDriveCan) {
  for (const auto& [from, to] : steps) {
    auto regulator = TestFixture::foreseen();
    begin<TypeParam>(regulator, from, to);
    double ratio = from;
    for (int i = 0; i < hold; ++i) {
      const double full = followed(ratio, least_ratio, presliding_periods);
      const double none = followed(ratio, 1.0, presliding_periods);
      const double expected = std::clamp(ratio + 0.25 * (to - ratio), full, none);
      ratio = followed(ratio, propose<TypeParam>(regulator, to, from), presliding_periods);
      constexpr double of_whole_periods = 0.015;  // the model steps where the contact moves
      ASSERT_NEAR(ratio, expected, of_whole_periods) << from << " to " << to << ", period " << i;
      regulator.accept(false, false);
    }
  }
}

TYPED_TEST(ContactForesightTest, FeedsNoReadingBackWhileTheIntegralIsHeld) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const auto& [from, to] : steps) {
    auto quiet = TestFixture::foreseen();
    auto ringing = TestFixture::foreseen();
    begin<TypeParam>(quiet, from, to);
    begin<TypeParam>(ringing, from, to);
    for (int i = 0; i < hold; ++i) {
      const double measured = i == 0 ? from : part(generator);
      ASSERT_EQ(propose<TypeParam>(quiet, to, from), propose<TypeParam>(ringing, to, measured));
      quiet.accept(false, false);
      ringing.accept(false, false);
    }
  }
}

TYPED_TEST(ContactForesightTest, KeepsTheCommandInItsRange) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  auto regulator = TestFixture::foreseen();
  double target = 0.5;
  regulator.restart(scaled<TypeParam>(0.5 * target));
  for (int i = 0; i < 5000; ++i) {
    if (i % 7 == 0) {
      const double next = i % 5 == 0 ? 1.0 : part(generator);
      regulator.target_changes(scaled<TypeParam>(0.5 * (next - target)));
      target = next;
    }
    const double commanded = propose<TypeParam>(regulator, target, 1.2 * part(generator) - 0.1);
    ASSERT_GE(commanded, 0.0);
    ASSERT_LE(commanded, 1.0);
    regulator.accept(commanded <= 0.0 || i % 3 == 0, 1.0 <= commanded || i % 11 == 0);
  }
}

/// One that foresees a prompt contact beside the regulator itself, in the same loop.
template <class Scalar, class Regulator>
void expect_the_same(const typename Regulator::Parameters& parameters) {
  typename ContactForesight<Regulator>::Parameters prompt{};
  prompt.regulator = parameters;
  ContactForesight<Regulator> foreseen(prompt);
  Regulator alone(parameters);
  std::mt19937 generator(35);
  std::uniform_real_distribution<double> part(-0.2, 0.2);
  double target = 0.5;
  double commanded = target;
  foreseen.restart(scaled<Scalar>(0.5 * target));
  alone.restart(scaled<Scalar>(0.5 * target));
  for (int i = 0; i < 3000; ++i) {
    if (i % 50 == 49) {
      const double next = 0.5 + part(generator);
      foreseen.target_changes(scaled<Scalar>(0.5 * (next - target)));
      alone.target_changes(scaled<Scalar>(0.5 * (next - target)));
      target = next;
    }
    const double measured = std::clamp(commanded + part(generator), 0.0, 1.0);
    commanded = propose<Scalar>(alone, target, measured);
    ASSERT_EQ(propose<Scalar>(foreseen, target, measured), commanded) << i;
    foreseen.accept(i % 7 == 0, i % 11 == 0);
    alone.accept(i % 7 == 0, i % 11 == 0);
  }
}

TYPED_TEST(ContactForesightTest, IsTheRegulatorWherePrompt) {
  expect_the_same<TypeParam, typename TestFixture::Integral>(TestFixture::integral());
  expect_the_same<TypeParam, typename TestFixture::Adaptive>(TestFixture::adaptive());
}

/// Periods until the ratio of a slow contact is within 0.02 of its target for good.
/// @param stiffness  of the contact, over that of the model
template <class Scalar, class Regulator>
int settling_periods(Regulator regulator, const Step& step, double stiffness) {
  begin<Scalar>(regulator, step.from, step.to);
  std::vector<double> commands(delay, step.from);
  double ratio = step.from;
  int settled = 0;
  constexpr int periods = 600;
  for (int i = 0; i < periods; ++i) {
    const double acting = std::max(least_ratio, commands[commands.size() - delay]);
    ratio = followed(ratio, acting, presliding_periods / stiffness);
    settled = std::abs(ratio - step.to) < 0.02 ? settled : i + 1;
    commands.push_back(propose<Scalar>(regulator, step.to, ratio));
    regulator.accept(acting <= least_ratio, 1.0 <= acting);
  }
  return settled;
}

TYPED_TEST(ContactForesightTest, SettlesSoonerThanTheRegulatorAlone) {
  for (const Step& step : steps) {
    for (const double stiffness : {2.0 / 3.0, 0.8, 1.0, 1.25}) {
      const int foreseen = settling_periods<TypeParam>(TestFixture::foreseen(), step, stiffness);
      const int alone = settling_periods<TypeParam>(
          typename TestFixture::Integral(TestFixture::integral()), step, stiffness);
      EXPECT_LT(foreseen, (stiffness == 1.0 ? 0.75 : 1.0) * alone)
          << step.from << " to " << step.to << ", " << stiffness;
    }
  }
}

/// A converter of so few bits that a slow contact stays within a code for longer than the detector grants.
TYPED_TEST(ContactForesightTest, LeavesACoarseSensorOfASlowContactUnsuspected) {
  constexpr double code = 1.0 / 16.0;
  constexpr std::uint16_t granted = 11;
  for (const double change : {-0.15, -0.08, -0.03, 0.03, 0.08, 0.15}) {
    auto regulator = TestFixture::foreseen();
    StuckDetector<TypeParam> detector({granted});
    double target = 0.5;
    begin<TypeParam>(regulator, 1.0, target);
    double ratio = 1.0;
    double overshot = 0.0;
    std::vector<TypeParam> implied(delay, scaled<TypeParam>(0.5 * target));
    for (int i = 0; i < 800; ++i) {
      if (i == 400) {
        regulator.target_changes(scaled<TypeParam>(0.5 * change));
        target += change;
      }
      const double reading = code * std::round(ratio / code);
      const auto half = scaled<TypeParam>(0.5 * reading);
      ASSERT_FALSE(detector.stuck(half, half, implied[implied.size() - delay], true))
          << change << ", period " << i;
      const double commanded = propose<TypeParam>(regulator, target, reading);
      implied.push_back(regulator.implied(scaled<TypeParam>(0.5 * commanded)));
      regulator.accept(commanded <= least_ratio, 1.0 <= commanded);
      overshot = std::max(overshot, std::abs(commanded - 2.0 * numeric::to_real(implied.back())));
      ratio = followed(ratio, std::max(least_ratio, commanded), presliding_periods);
    }
    EXPECT_GT(overshot, 0.25);  // by which a detector is told
  }
}

TYPED_TEST(ContactForesightTest, SettlesAContactOfTwiceTheStiffnessAfterAnOvershoot) {
  for (const Step& step : steps) {
    EXPECT_LT(settling_periods<TypeParam>(TestFixture::foreseen(), step, 2.0), 80);
  }
}

}  // namespace
}  // namespace sonoglide::control::contact_foresight_test
