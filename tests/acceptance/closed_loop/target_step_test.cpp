#include <gtest/gtest.h>

#include <string>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"

namespace sonoglide::acceptance::target_step_test {
namespace {

constexpr double period_s = 1.0 / 60e3;
/// Ten carrier periods, with room for the rounding of times.
constexpr Bounds ideal{10.001 * period_s, 0.001, 0.002};

class TargetStepTest : public testing::TestWithParam<std::string> {
 protected:
  Settings arithmetic() const { return {"controller.arithmetic=" + GetParam()}; }
};

TEST_P(TargetStepTest, SettlesInTenCarrierPeriods) {
  const nlohmann::json summary = summary_of("target_step", arithmetic());
  expect_steps_within(summary, ideal);
  EXPECT_EQ(steps_of(summary).size(), 3U);
  EXPECT_EQ(summary.at("control").at("arithmetic"), GetParam());
  EXPECT_EQ(summary.at("control").at("saturated_fraction"), 0.0);
}

TEST_P(TargetStepTest, OvershootsByLessThanAThousandth) {
  for (const Step& step : steps_of(summary_of("target_step", arithmetic()))) {
    EXPECT_LE(step.overshoot, 0.001) << step.target;
  }
}

TEST_P(TargetStepTest, HoldsForSixtyMilliseconds) {
  Settings settings = arithmetic();
  settings.push_back("run.duration_s=60e-3");
  settings.push_back("run.record=[]");
  settings.push_back("controller.target_friction_ratio=[[0.0,0.4],[20e-3,0.6],[40e-3,0.5]]");
  expect_steps_within(summary_of("target_step", settings), ideal);
}

INSTANTIATE_TEST_SUITE_P(Arithmetic, TargetStepTest, testing::ValuesIn(arithmetics),
                         [](const auto& arithmetic) { return arithmetic.param; });

TEST(TargetStepFilesTest, FloatAndFixedPointScenesDifferInArithmeticAlone) {
  for (const char* arithmetic : {"float64", "q31"}) {
    const std::string name = std::string("target_step_") + arithmetic;
    nlohmann::json own = summary_of(name).at("scene");
    nlohmann::json base =
        summary_of("target_step", {std::string("controller.arithmetic=") + arithmetic}).at("scene");
    own.erase("name");
    base.erase("name");
    EXPECT_EQ(own, base);
  }
}

TEST(TargetStepFilesTest, NamesNoSolverAndGetsTheFastest) {
  const nlohmann::json fastest = summary_of("target_step");
  EXPECT_EQ(fastest.at("solver").at("method"), "event_gauss");
  EXPECT_EQ(fastest.at("scene").at("solver").at("method"), "event_gauss");
  EXPECT_LE(fastest.at("solver").at("steps"), 1.05 * 360);  // one for each carrier period
  const nlohmann::json taylor = summary_of("target_step", {"solver.method=event_taylor"});
  EXPECT_EQ(taylor.at("solver").at("method"), "event_taylor");
  EXPECT_EQ(fastest.at("control").at("trace_hash"), taylor.at("control").at("trace_hash"));
  EXPECT_NEAR(fastest.at("friction_ratio").at("whole_run"),
              taylor.at("friction_ratio").at("whole_run"), 1e-12);
}

TEST(UnshapedTargetStepTest, RingsTheNaturalModeForEver) {
  const nlohmann::json summary = summary_of("target_step_unshaped");
  expect_no_fault(summary);
  ASSERT_EQ(steps_of(summary).size(), 3U);
  for (const Step& step : steps_of(summary)) {
    EXPECT_FALSE(step.settling_time_s) << step.target;
    EXPECT_GT(step.ripple, 0.15) << step.target;
    EXPECT_LT(step.ripple, 0.45) << step.target;
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::target_step_test
