/// Each number and each quality of a sample has a fault of its own.

#include "firmware/control/limits/sample_inspection.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "firmware/control/force_sensing.hpp"
#include "scalars.hpp"

namespace sonoglide::control::sample_inspection_test {
namespace {

template <class Scalar>
class SampleInspection : public testing::Test {
 protected:
  static MotionMeasurement<Scalar> usable() {
    MotionMeasurement<Scalar> sample{};
    sample.friction_force = Scalar(0.2);
    sample.sliding_velocity = Scalar(0.1);
    sample.in_phase = Scalar(0.3);
    sample.quadrature = Scalar(-0.3);
    sample.mean_velocity = Scalar(0.1);
    return sample;
  }
};
TYPED_TEST_SUITE(SampleInspection, FloatingScalars);

TYPED_TEST(SampleInspection, RefusesANumberThatIsNotFiniteWhereverItIs) {
  using Limits = std::numeric_limits<TypeParam>;
  using Motion = MotionMeasurement<TypeParam>;
  EXPECT_EQ((inspect<ForceSensor, Numbers::any>(this->usable())), Fault::none);
  for (TypeParam Motion::*const number :
       {static_cast<TypeParam Motion::*>(&Motion::friction_force),
        static_cast<TypeParam Motion::*>(&Motion::sliding_velocity),
        static_cast<TypeParam Motion::*>(&Motion::in_phase),
        static_cast<TypeParam Motion::*>(&Motion::quadrature), &Motion::mean_velocity}) {
    for (const TypeParam bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
      auto sample = this->usable();
      sample.*number = bad;
      EXPECT_EQ((inspect<ForceSensor, Numbers::any>(sample)), Fault::measurement_not_finite);
    }
  }
}

TYPED_TEST(SampleInspection, LooksAtAForceOnlyWhereThereIsASensor) {
  auto sample = this->usable();
  sample.friction_force = std::numeric_limits<TypeParam>::quiet_NaN();
  EXPECT_EQ((inspect<NoForceSensor, Numbers::any>(sample)), Fault::none);
  sample.quality = Quality::saturated;
  EXPECT_EQ((inspect<NoForceSensor, Numbers::any>(sample)), Fault::none);
  EXPECT_EQ((inspect<ForceSensor, Numbers::any>(sample)), Fault::measurement_saturated);
  sample.quality = Quality::missing;
  EXPECT_EQ((inspect<NoForceSensor, Numbers::any>(sample)), Fault::measurement_missing);
}

/// A vibration that cannot be used is named before numbers that are not finite.
TYPED_TEST(SampleInspection, NamesTheVibration) {
  auto sample = this->usable();
  sample.mean_velocity = std::numeric_limits<TypeParam>::quiet_NaN();
  sample.vibration_quality = Quality::missing;
  EXPECT_EQ((inspect<ForceSensor, Numbers::any>(sample)), Fault::vibration_missing);
  sample.vibration_quality = Quality::saturated;
  EXPECT_EQ((inspect<ForceSensor, Numbers::any>(sample)), Fault::vibration_saturated);
}

}  // namespace
}  // namespace sonoglide::control::sample_inspection_test
