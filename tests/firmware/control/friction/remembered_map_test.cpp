// The inverse map where its arguments stay.
#include "firmware/control/friction/remembered_map.hpp"

#include <gtest/gtest.h>

namespace sonoglide::control::remembered_map_test {
namespace {

struct CountedMap {
  using Scalar = double;
  double factor = 1.0;
  mutable int evaluations = 0;

  double amplitude(double half_ratio, double speed) const {
    ++evaluations;
    return factor * (half_ratio + 2.0 * speed);
  }
};

TEST(RememberedMap, IsEvaluatedWhereAnArgumentIsAnother) {
  CountedMap feedforward;
  RememberedMap<CountedMap> map;
  for (int period = 0; period < 5; ++period) {
    EXPECT_EQ(map.amplitude(feedforward, 0.25, 0.5), 1.25);
  }
  EXPECT_EQ(feedforward.evaluations, 1);
  EXPECT_EQ(map.amplitude(feedforward, 0.125, 0.5), 1.125);
  EXPECT_EQ(map.amplitude(feedforward, 0.125, 0.25), 0.625);
  EXPECT_EQ(feedforward.evaluations, 3);
}

TEST(RememberedMap, ForgetsWhenTheMapChanges) {
  CountedMap feedforward;
  RememberedMap<CountedMap> map;
  map.amplitude(feedforward, 0.25, 0.5);
  feedforward.factor = 2.0;
  map.forget();
  EXPECT_EQ(map.amplitude(feedforward, 0.25, 0.5), 2.5);
}

TEST(EvaluatedMap, IsEvaluatedEachTime) {
  const CountedMap feedforward;
  EvaluatedMap<CountedMap>::amplitude(feedforward, 0.25, 0.5);
  EXPECT_EQ(EvaluatedMap<CountedMap>::amplitude(feedforward, 0.25, 0.5), 1.25);
  EXPECT_EQ(feedforward.evaluations, 2);
}

}  // namespace
}  // namespace sonoglide::control::remembered_map_test
