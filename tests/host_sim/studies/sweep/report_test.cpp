#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "host_sim/studies/sweep/report.hpp"
#include "tests/host_sim/studies/sweep/scenes/base_scenes.hpp"
#include "tests/host_sim/studies/sweep/scenes/scratch_scene.hpp"

namespace sonoglide::sweep::report_test {
namespace {

PointResult row(double ratio) {
  PointResult filled;
  filled.friction_ratio_whole_run = ratio;
  filled.friction_ratio_window = 0.5;
  filled.dissipation_ratio_window = 0.25;
  return filled;
}

TEST(CsvTest, HasOneRowForEachPointAndQuotesReasons) {
  const ScratchScene scratch(open_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {}, {"friction.coefficient=0.1:0.2:2"});
  PointResult failed;
  failed.status = "solver: at 1 s, |F| > \"Fc\"";
  std::ostringstream out;
  write_csv(out, plan, {row(0.125), failed});
  EXPECT_EQ(out.str(),
            "friction.coefficient,friction_ratio_whole_run,friction_ratio_window,"
            "dissipation_ratio_window,status\n"
            "0.1,0.125,0.5,0.25,ok\n"
            "0.2,nan,nan,nan,\"solver: at 1 s, |F| > \"\"Fc\"\"\"\n");
}

TEST(CsvTest, AClosedLoopHasItsLastStep) {
  const ScratchScene scratch(closed_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {}, {"sensor.seed=1:1:1"});
  PointResult limited = row(0.125);
  limited.steady_error = -0.5;
  limited.ripple = 0.0;
  limited.limit = control::Limit::actuator;
  limited.fault = control::Fault::measurement_stuck;
  std::ostringstream out;
  write_csv(out, plan, {limited});
  EXPECT_EQ(out.str(),
            "sensor.seed,friction_ratio_whole_run,friction_ratio_window,dissipation_ratio_window,"
            "settling_time_s,steady_error,ripple,limit,fault,status\n"
            "1,0.125,0.5,0.25,nan,-0.5,0,actuator,measurement_stuck,ok\n");
}

TEST(ExtremesTest, PassOverWhatIsNotDefined) {
  const std::vector<PointResult> rows = {PointResult(), row(0.5), row(0.25), row(0.75), row(0.25)};
  const auto found = extremes(rows, &PointResult::friction_ratio_whole_run);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->lowest, 2U);
  EXPECT_EQ(found->highest, 3U);
  EXPECT_FALSE(extremes(rows, &PointResult::ripple).has_value());
}

}  // namespace
}  // namespace sonoglide::sweep::report_test
