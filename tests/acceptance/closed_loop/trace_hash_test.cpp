/// The drive commands bit for bit: the same with every compiler, at every optimisation level.
#include <gtest/gtest.h>

#include <string>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"

namespace sonoglide::acceptance {
namespace {

std::string hash_of(const std::string& scene, const Settings& settings = {}) {
  return summary_of(scene, settings).at("control").at("trace_hash");
}

TEST(TraceHashTest, IsTheGoldenOneOfEachArithmetic) {
  EXPECT_EQ(hash_of("target_step"), "9045627229f6eeb1");
  EXPECT_EQ(hash_of("target_step_float64"), "d1ffe001545d68c5");
  EXPECT_EQ(hash_of("target_step_q31"), "4f5c6407b657d689");
}

TEST(TraceHashTest, IsTheSameEachTime) {
  for (const char* scene : {"noisy_sensor", "unreachable_target"}) {
    EXPECT_EQ(hash_of(scene), hash_of(scene));
  }
}

TEST(TraceHashTest, DoesNotDependOnWhatIsRecorded) {
  EXPECT_EQ(hash_of("target_step", {"run.record=[]"}), hash_of("target_step"));
  EXPECT_EQ(hash_of("target_step", {"run.record_interval_s=0.13e-6"}), hash_of("target_step"));
}

TEST(TraceHashTest, DependsOnTheSensorsSeed) {
  EXPECT_NE(hash_of("noisy_sensor", {"sensor.seed=2"}), hash_of("noisy_sensor"));
}

}  // namespace
}  // namespace sonoglide::acceptance
