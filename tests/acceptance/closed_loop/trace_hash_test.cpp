/// The drive commands bit for bit: the same with every compiler, at every optimisation level.
#include <gtest/gtest.h>

#include <string>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"

namespace sonoglide::acceptance::trace_hash_test {
namespace {

std::string hash_of(const std::string& scene, const Settings& settings = {}) {
  return summary_of(scene, settings).at("control").at("trace_hash");
}

TEST(TraceHashTest, IsTheGoldenOneOfEachArithmetic) {
  EXPECT_EQ(hash_of("target_step"), "e874d74ba032279f");
  EXPECT_EQ(hash_of("target_step_float64"), "5489c211d1c0ba51");
  EXPECT_EQ(hash_of("target_step_q31"), "c5c551f3e19c4471");
  EXPECT_EQ(hash_of("target_step_q15"), "68e9d3e6b8b0e7bb");
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
}  // namespace sonoglide::acceptance::trace_hash_test
