#include "firmware/control/limits/sample_inspection.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdint>
#include <deque>
#include <numeric>

#include "closed_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::tolerant_samples_test {
namespace {

/// Counted one by one.
bool allowed(std::deque<int>& last, bool usable, int tolerated, std::size_t window) {
  last.push_back(usable ? 0 : 1);
  if (last.size() > window) {
    last.pop_front();
  }
  return usable || std::accumulate(last.begin(), last.end(), 0) <= tolerated;
}

TEST(TolerantSamplesTest, AcceptsWhatCountingAllows) {
  EXPECT_TRUE(rc::check([] {
    const auto window = *rc::gen::inRange<std::uint8_t>(1, 33);
    const auto tolerated = *rc::gen::inRange<std::uint8_t>(0, window);
    TolerantSamples samples({tolerated, window});
    std::deque<int> last;
    for (int i = 0; i < 200; ++i) {
      const bool usable = *rc::gen::inRange(0, 4) != 0;
      RC_ASSERT(samples.accept(usable) == allowed(last, usable, tolerated, window));
    }
  }));
}

template <class S>
using TolerantParts =
    Parts<S, TrustedFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>,
          NotchShaper<S, longest_spacing>, IntegralRegulator<S, longest_delay>, NoRelearning<S>,
          FedForward<S>, ForceSensor, RatioTarget<S>, FullDrive<S>, TolerantSamples>;

template <class Scalar>
class ToleratedSamples : public testing::Test {
 protected:
  static Controller<TolerantParts<Scalar>> controller(std::uint8_t tolerated) {
    auto all = parameters<TolerantParts<Scalar>>(Design{});
    all.samples = {tolerated, 10};
    Controller<TolerantParts<Scalar>> controller(all);
    controller.start();
    controller.set_target(scaled<Scalar>(0.25));
    return controller;
  }
};
TYPED_TEST_SUITE(ToleratedSamples, Scalars);

TYPED_TEST(ToleratedSamples, AreBridgedByTheLastRequestAndNamed) {
  auto controller = this->controller(2);
  const Measurement<TypeParam> good{scaled<TypeParam>(0.25), scaled<TypeParam>(0.1), Quality::good};
  auto bad = good;
  bad.quality = Quality::missing;
  for (int i = 0; i < 40; ++i) {
    controller.step(
        {scaled<TypeParam>(0.25 + 0.001 * (i % 2)), scaled<TypeParam>(0.1), Quality::good});
  }
  const auto before = controller.step(good);
  for (int i = 0; i < 2; ++i) {
    const auto command = controller.step(bad);
    EXPECT_EQ(command.limit, Limit::bad_sample);
    EXPECT_EQ(command.fault, Fault::none);
    EXPECT_NEAR(numeric::to_real(command.amplitude), numeric::to_real(before.amplitude), 0.01);
  }
  EXPECT_EQ(controller.step(bad).fault, Fault::measurement_missing);
}

TYPED_TEST(ToleratedSamples, NoneIsAsStrictAsStrict) {
  auto controller = this->controller(0);
  Measurement<TypeParam> bad{scaled<TypeParam>(0.25), scaled<TypeParam>(0.1), Quality::saturated};
  EXPECT_EQ(controller.step(bad).fault, Fault::measurement_saturated);
}

TYPED_TEST(ToleratedSamples, OfACalibrationAreLeftOutOfIt) {
  using S = TypeParam;
  using Calibrating =
      Parts<S, LearntFriction<S>, DahlFeedforward<S>, NoSlewLimit<S>,
            NotchShaper<S, longest_spacing>, IntegralRegulator<S, longest_delay>, NoRelearning<S>,
            FedForward<S>, ForceSensor, RatioTarget<S>, FullDrive<S>, TolerantSamples>;
  const Design design;
  auto all = parameters<Calibrating>(design);
  all.samples = {2, 10};
  Controller<Calibrating> controller(all);
  controller.start();
  const Measurement<S> good{scaled<S>(0.4), scaled<S>(0.1), Quality::good};
  const Measurement<S> bad{scaled<S>(-0.9), scaled<S>(0.1), Quality::saturated};
  const auto samples = static_cast<int>(design.settle_periods + design.average_periods);
  for (int i = 0; i < samples; ++i) {
    if (i % 16 == 5) {
      const auto command = controller.step(bad);
      EXPECT_EQ(command.state, State::calibrating);
      EXPECT_EQ(command.limit, Limit::bad_sample);
      EXPECT_EQ(command.amplitude, S{});
    }
    EXPECT_EQ(controller.step(good).state, State::calibrating);
  }
  EXPECT_EQ(controller.step(good).state, State::running);
  EXPECT_NEAR(numeric::to_real(controller.friction_level().force()), 0.4, 1e-6);
}

}  // namespace
}  // namespace sonoglide::control::tolerant_samples_test
