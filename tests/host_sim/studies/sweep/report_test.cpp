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

TEST(CsvTest, ATextureHasItsLargestHarmonic) {
  const ScratchScene scratch(closed_loop);
  const auto csv = [&](const char* texture) {
    const Plan plan(scene_file::read_source(scratch.file()),
                    {"controller.target_friction_ratio=",
                     std::string("controller.target_texture={ period_m = 1e-4, ") + texture + " }"},
                    {"sensor.seed=1:1:1"});
    PointResult filled = row(0.125);
    filled.texture_mean_error = 0.25;
    filled.texture_amplitude_ratio = 0.75;
    filled.texture_lag_deg = -2.0;
    std::ostringstream out;
    write_csv(out, plan, {filled});
    return out.str();
  };
  EXPECT_EQ(csv("ratio = [0.4, 0.6]"),
            "sensor.seed,friction_ratio_whole_run,friction_ratio_window,dissipation_ratio_window,"
            "texture_mean_error,texture_amplitude_ratio,texture_lag_deg,fault,status\n"
            "1,0.125,0.5,0.25,0.25,0.75,-2,none,ok\n");
  EXPECT_NE(csv("force_N = [0.008, 0.012]").find(",texture_mean_error_N,texture_amplitude_ratio,"),
            std::string::npos);
}

TEST(CsvTest, ALoadHasItsEnd) {
  const ScratchScene scratch(open_loop);
  const Plan plan(
      scene_file::read_source(scratch.file()),
      {"sliding.velocity_m_per_s=", "load.mass_kg=0.5", "load.initial_velocity_m_per_s=0.02672"},
      {"friction.coefficient=0.1:0.1:1"});
  PointResult moved = row(0.125);
  moved.load_final_velocity_m_per_s = -0.5;
  moved.load_final_displacement_m = 2.0;
  std::ostringstream out;
  write_csv(out, plan, {moved});
  EXPECT_EQ(
      out.str(),
      "friction.coefficient,friction_ratio_whole_run,friction_ratio_window,"
      "dissipation_ratio_window,load_final_velocity_m_per_s,load_final_displacement_m,status\n"
      "0.1,0.125,0.5,0.25,-0.5,2,ok\n");
  EXPECT_EQ(subject(plan).figure, &PointResult::load_final_displacement_m);
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
