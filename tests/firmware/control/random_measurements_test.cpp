/// Whatever is measured, the command is an amplitude that the board can drive.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdint>
#include <limits>

#include "closed_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::random_measurements_test {
namespace {

std::int32_t any_code() {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::int32_t>());
}

Quality any_quality() {
  return *rc::gen::weightedElement<Quality>(
      {{200, Quality::good}, {1, Quality::saturated}, {1, Quality::missing}});
}

template <class Scalar>
void check_command(const DriveCommand<Scalar>& command) {
  const double amplitude = numeric::to_real(command.amplitude);
  RC_ASSERT(amplitude >= 0.0 && amplitude <= 1.0);
  RC_ASSERT((command.state == State::fault) == (command.fault != Fault::none));
  RC_ASSERT(command.state != State::running || command.limit == Limit::none);
  RC_ASSERT(command.state != State::limited || command.limit != Limit::none);
  if (command.state != State::running && command.state != State::limited) {
    RC_ASSERT(amplitude == 0.0);
  }
}

/// Any codes and qualities, any targets, restarts in between.
template <class PartsT>
void step_through_anything() {
  using Scalar = typename PartsT::Scalar;
  Controller<PartsT> controller(parameters<PartsT>(Design{}));
  for (int i = 0; i < 200; ++i) {
    if (*rc::gen::inRange(0, 40) == 0) {
      controller.start();
    }
    if (*rc::gen::inRange(0, 10) == 0) {
      controller.set_target(numeric::from_code<Scalar>(any_code()));
    }
    check_command(controller.step({numeric::from_code<Scalar>(any_code()),
                                   numeric::from_code<Scalar>(any_code()), any_quality()}));
  }
}

template <class Scalar>
class RandomMeasurements : public testing::Test {};
using Clamping = testing::Types<double, float, Saturated>;
TYPED_TEST_SUITE(RandomMeasurements, Clamping);

TYPED_TEST(RandomMeasurements, NeverLeadOutsideTheDrivesRange) {
  EXPECT_TRUE(rc::check(step_through_anything<FullParts<TypeParam>>));
  EXPECT_TRUE(rc::check(step_through_anything<ShapedParts<TypeParam>>));
  EXPECT_TRUE(rc::check(step_through_anything<BareParts<TypeParam>>));
}

template <class Scalar>
class ExtremeMeasurements : public testing::Test {};
TYPED_TEST_SUITE(ExtremeMeasurements, FloatingScalars);

// No converter gives these; a board with a fault of its own may.
TYPED_TEST(ExtremeMeasurements, NeverLeadOutsideTheDrivesRange) {
  EXPECT_TRUE(rc::check([] {
    const TypeParam most = std::numeric_limits<TypeParam>::max();
    const TypeParam least = std::numeric_limits<TypeParam>::denorm_min();
    const auto any = [&]() -> TypeParam {
      return *rc::gen::element<TypeParam>(0, most, -most, most / 2, -most / 2, 1, -1, 40, -40,
                                          TypeParam(0.1), TypeParam(1e30), least, -least);
    };
    Controller<ShapedParts<TypeParam>> controller(parameters<ShapedParts<TypeParam>>(Design{}));
    controller.start();
    controller.set_target(*rc::gen::element<TypeParam>(0, TypeParam(0.2), TypeParam(0.45), least));
    for (int i = 0; i < 50; ++i) {
      check_command(controller.step({any(), any(), Quality::good}));
    }
  }));
}

/// Noise of a tenth of Fc, wandering speed, targets within reach: nothing overflows.
template <class PartsT>
void step_through_noise() {
  ClosedLoop<PartsT> loop({});
  double velocity = 0.1;
  for (int i = 0; i < 300; ++i) {
    if (i % 60 == 0) {
      loop.set_target(*rc::gen::inRange(35, 96) * 0.01);
    }
    velocity += *rc::gen::inRange(-10, 11) * 1e-4;
    const double noise = *rc::gen::inRange(-500, 501) * 1e-4;
    check_command(loop.step(velocity, noise));
    RC_ASSERT(loop.amplitude() > 0.0);
  }
}

TEST(NormalOperation, OverflowsNothingInFixedPoint) {
  EXPECT_TRUE(rc::check(step_through_noise<ShapedParts<Trapped>>));
  EXPECT_TRUE(rc::check(step_through_noise<SlewingParts<Trapped>>));
  EXPECT_TRUE(rc::check(step_through_noise<UnshapedParts<Trapped>>));
}

}  // namespace
}  // namespace sonoglide::control::random_measurements_test
