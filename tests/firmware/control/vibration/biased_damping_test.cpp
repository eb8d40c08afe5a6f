/// The bias against a slow natural mode: its gain, its limit, its silence in a fault, and what it answers.
/// With a plant: tests/acceptance/closed_loop/slow_mode_test.cpp.

#include "firmware/control/vibration/biased_damping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "firmware/control/vibration/fed_forward.hpp"
#include "scalars.hpp"

namespace sonoglide::control::biased_damping_test {
namespace {

template <class S>
BiasFeedback<S> feedback(double gain) {
  const numeric::Split<double> parts = numeric::split(gain);
  return BiasFeedback<S>(
      typename BiasFeedback<S>::Parameters{{scaled<S>(parts.mantissa), parts.exponent}});
}

template <class S>
BiasedCommand<S> running() {
  BiasedCommand<S> command{};
  command.state = State::running;
  return command;
}

template <class S>
class BiasFeedbackTest : public testing::Test {};
TYPED_TEST_SUITE(BiasFeedbackTest, Scalars);

/// The sentence of BiasFeedback: in Q31 off by at most 2^max(e, 1) units of the last place.
TYPED_TEST(BiasFeedbackTest, AnswersWithItsGainAndIsNamedAtItsLimit) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> velocity(-1.0, 1.0);
  std::uniform_real_distribution<double> exponent(-12.0, 12.0);
  const auto largest =
      static_cast<long double>(numeric::to_real(numeric::from_code<TypeParam>(INT32_MAX)));
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < 20000; ++i) {
    const double gain_wanted = std::exp2(exponent(generator));
    const numeric::Split<double> parts = numeric::split(gain_wanted);
    const auto mantissa = scaled<TypeParam>(parts.mantissa);
    const long double gain = std::ldexp(static_cast<long double>(numeric::to_real(mantissa)),
                                        static_cast<int>(parts.exponent));
    const auto v = scaled<TypeParam>(velocity(generator));
    const long double exact = -gain * static_cast<long double>(numeric::to_real(v));
    BiasedCommand<TypeParam> command = running<TypeParam>();
    const typename BiasFeedback<TypeParam>::Parameters parameters{{mantissa, parts.exponent}};
    BiasFeedback<TypeParam>(parameters).answer(v, command);
    const double unit = numeric::is_fixed_point_v<TypeParam> ? 0x1p-31
                        : sizeof(TypeParam) == 4             ? 0x1p-24
                                                             : 0x1p-53;
    const double bound = std::ldexp(unit, std::max(parts.exponent, 1));
    const auto exact_bound = static_cast<long double>(bound);
    const double bias = numeric::to_real(command.bias);
    EXPECT_NEAR(bias, static_cast<double>(std::clamp(exact, -largest, largest)), bound)
        << gain_wanted << " " << numeric::to_real(v);
    if (std::abs(exact) > 1.0L + exact_bound) {
      EXPECT_EQ(command.limit, Limit::bias);
      EXPECT_EQ(command.state, State::limited);
      ++outside;
    } else if (std::abs(exact) < 1.0L - exact_bound) {
      EXPECT_EQ(command.limit, Limit::none);
      EXPECT_EQ(command.state, State::running);
      ++inside;
    }
  }
  EXPECT_GT(inside, 5000);
  EXPECT_GT(outside, 2000);
}

TYPED_TEST(BiasFeedbackTest, IsZeroInAFaultAndWhileOff) {
  for (const State state : {State::off, State::fault}) {
    BiasedCommand<TypeParam> command = running<TypeParam>();
    command.state = state;
    feedback<TypeParam>(4.0).answer(scaled<TypeParam>(0.9), command);
    EXPECT_EQ(command.bias, TypeParam{});
    EXPECT_EQ(command.limit, Limit::none);
    EXPECT_EQ(command.state, state);
  }
}

TYPED_TEST(BiasFeedbackTest, LeavesAnotherLimitItsName) {
  BiasedCommand<TypeParam> command = running<TypeParam>();
  command.state = State::limited;
  command.limit = Limit::not_settling;
  feedback<TypeParam>(4.0).answer(scaled<TypeParam>(-0.9), command);
  EXPECT_EQ(command.limit, Limit::not_settling);
  EXPECT_NEAR(numeric::to_real(command.bias), 1.0, 1e-6);
}

TYPED_TEST(BiasFeedbackTest, DampsWhileTheFrictionIsLearntWithoutAnotherState) {
  BiasedCommand<TypeParam> command = running<TypeParam>();
  command.state = State::calibrating;
  feedback<TypeParam>(4.0).answer(scaled<TypeParam>(0.9), command);
  EXPECT_EQ(command.state, State::calibrating);
  EXPECT_EQ(command.limit, Limit::bias);
  EXPECT_NEAR(numeric::to_real(command.bias), -1.0, 1e-6);
}

/// The sample of the period is answered, not the one before.
TYPED_TEST(BiasFeedbackTest, OfAVibrationSensorAnswersItsMeanVelocity) {
  using Loop = BiasedDampedVibration<TypeParam, 2>;
  typename Loop::Parameters parameters{};
  parameters.vibration.delay = 1;
  const numeric::Split<double> gain = numeric::split(0.75);
  parameters.bias.gain = {scaled<TypeParam>(gain.mantissa), gain.exponent};
  Loop loop(parameters);
  for (const double velocity : {0.5, -0.25, 0.0}) {
    MotionMeasurement<TypeParam> measurement{};
    measurement.mean_velocity = scaled<TypeParam>(velocity);
    loop.observe(measurement);
    BiasedCommand<TypeParam> command = running<TypeParam>();
    loop.after(command);
    EXPECT_NEAR(numeric::to_real(command.bias), -0.75 * velocity, 1e-7);
  }
}

template <class S>
typename FrictionBalance<S>::Parameters balance(double per_force) {
  const numeric::Split<double> parts = numeric::split(per_force);
  return {{scaled<S>(parts.mantissa), parts.exponent}};
}

template <class S>
class FrictionBalanceTest : public testing::Test {};
TYPED_TEST_SUITE(FrictionBalanceTest, Scalars);

/// b = F, limited and named; of an unusable sample that of the one before.
TYPED_TEST(FrictionBalanceTest, TakesTheExpectedFrictionFromTheMass) {
  BalancedFedForward<TypeParam> loop(balance<TypeParam>(1.5));
  const auto biased = [&](double force, Limit limit, State state = State::running) {
    BiasedCommand<TypeParam> command = running<TypeParam>();
    command.limit = limit;
    command.state = state;
    loop.balance(command, [&] { return scaled<TypeParam>(force); });
    loop.after(command);
    return command;
  };
  EXPECT_NEAR(numeric::to_real(biased(0.5, Limit::none).bias), 0.75, 1e-6);
  EXPECT_NEAR(numeric::to_real(biased(-0.25, Limit::none).bias), -0.375, 1e-6);
  EXPECT_NEAR(numeric::to_real(biased(0.125, Limit::bad_sample).bias), -0.375, 1e-6);
  EXPECT_EQ(biased(0.25, Limit::none).limit, Limit::none);
  EXPECT_EQ(biased(0.75, Limit::none).limit, Limit::bias);
  EXPECT_NEAR(numeric::to_real(biased(-0.75, Limit::none).bias), -1.0, 1e-6);
  for (const State state : {State::off, State::fault}) {
    EXPECT_EQ(biased(0.5, Limit::none, state).bias, TypeParam{});
  }
}

/// Beside a damper their sum is limited. What is told of the damper is what is left of it.
TYPED_TEST(FrictionBalanceTest, LeavesTheDamperWhatIsLeftOfTheRange) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> part(-0.99, 0.99);
  for (int i = 0; i < 10000; ++i) {
    const double velocity = part(generator);
    const double friction = part(generator);
    BiasedCommand<TypeParam> command = running<TypeParam>();
    const TypeParam damper = feedback<TypeParam>(1.0).answer(scaled<TypeParam>(velocity), command,
                                                             scaled<TypeParam>(friction));
    const double sum = std::clamp(friction - velocity, -1.0, 1.0);
    EXPECT_NEAR(numeric::to_real(command.bias), sum, 3e-7) << velocity << " " << friction;
    EXPECT_NEAR(numeric::to_real(damper), std::clamp(sum - friction, -1.0, 1.0), 3e-7);
  }
}

}  // namespace
}  // namespace sonoglide::control::biased_damping_test
