/// A sweep whose first point is unlike the others.

#include "host_sim/studies/sweep/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/process/thread_limit.hpp"
#include "tests/host_sim/studies/sweep/scenes/base_scenes.hpp"
#include "tests/host_sim/studies/sweep/scenes/scratch_scene.hpp"

namespace sonoglide::sweep::solve_test {
namespace {

/// Without friction the lanes have nothing to solve.
const char* const frictionless_first = "friction.coefficient=0:0.2:5";

/// 1 kHz off resonance at Table 1.
TEST(SolvePoint, OfATextureHasTheFiguresOfItsLargestHarmonic) {
  const ScratchScene scratch(closed_loop);
  const Plan plan(
      scene_file::read_source(scratch.file()),
      {"run.duration_periods=480", "controller.target_friction_ratio=",
       "controller.target_texture={ period_m = 26.72e-6, ratio = [0.5, 0.64, 0.7, 0.64, 0.5, "
       "0.36, 0.3, 0.36] }"},
      {"sensor.seed=1:1:1"});
  const PointResult row = solve_scalar_point(plan.experiment(0));
  EXPECT_TRUE(row.ok());
  EXPECT_EQ(row.fault, control::Fault::none);
  EXPECT_NEAR(row.texture_mean_error, 0.0, 0.01);
  EXPECT_NEAR(row.texture_amplitude_ratio, 1.0, 0.05);
  EXPECT_NEAR(row.texture_lag_deg, 0.0, 20.0);
  EXPECT_TRUE(std::isnan(row.settling_time_s));
}

/// Coulomb friction without a drive: M v falls by the friction, and x = (v0 + v) t / 2.
TEST(SolvePoint, OfALoadTellsWhereItEnds) {
  const ScratchScene scratch(open_loop);
  const Plan plan(
      scene_file::read_source(scratch.file()),
      {"sliding.velocity_m_per_s=", "load.mass_kg=0.5", "load.initial_velocity_m_per_s=0.1",
       "friction.law=coulomb", "friction.contact_stiffness_N_per_m=", "drive.force_amplitude_N=0"},
      {"friction.coefficient=0.1:0.2:2"});
  const PointResult row = solve_scalar_point(plan.experiment(1));
  const double time_s = plan.first().run.duration_s;
  const double end_m_per_s = 0.1 - 0.2 * 0.1962 / 0.5 * time_s;
  EXPECT_TRUE(row.ok());
  EXPECT_NEAR(row.load_final_velocity_m_per_s, end_m_per_s, 1e-9);
  EXPECT_NEAR(row.load_final_displacement_m, 0.5 * (0.1 + end_m_per_s) * time_s, 1e-11);
}

class SolveTest : public testing::Test {
 protected:
  void plan_for(const std::vector<std::string>& vary) {
    plan_.emplace(scene_file::read_source(scratch_.file()),
                  std::vector<std::string>{"solver.tolerance=1e-4"}, vary);
    solve_.emplace(*plan_, plan_->all(), &pace_);
    for (std::size_t point = 0; point < plan_->grid().size(); ++point) {
      all_.push_back(point);
    }
  }
  std::map<std::size_t, std::string> records(const runs::Calls& calls) const {
    std::mutex mutex;
    std::map<std::size_t, std::string> found;
    (*solve_)(calls, [&](const std::vector<Record>& finished) {
      const std::lock_guard<std::mutex> lock(mutex);
      for (const Record& record : finished) {
        found[record.point] = record_text(record);
      }
    });
    return found;
  }

  ScratchScene scratch_{open_loop};
  long_work::Progress nobody_;
  long_work::Pace pace_{nobody_};
  std::optional<Plan> plan_;
  std::optional<Solve> solve_;
  runs::Places all_;
};

TEST_F(SolveTest, LanesTakeTheOthersTogether) {
  plan_for({frictionless_first});
  const runs::Calls calls = solve_->calls(all_);
  EXPECT_EQ(calls.together, (std::vector<runs::Places>{{1, 2, 3, 4}}));
  EXPECT_EQ(calls.alone, (runs::Places{0}));
  const std::map<std::size_t, std::string> together = records(calls);
  EXPECT_EQ(together.at(0), record_text(Record{0, solve_scalar_point(plan_->experiment(0))}));
  EXPECT_EQ(together, records({{{1}, {2}, {3}, {4}}, {0}})) << "to the bit what each is alone";
}

TEST_F(SolveTest, PointsOfOneLengthGoTogetherWhereverTheyAre) {
  const process::ThreadLimit limit(2);
  plan_for({"friction.coefficient=0.1:0.2:300", "run.duration_periods=30:31:2"});
  const runs::Calls calls = solve_->calls(all_);
  EXPECT_TRUE(calls.alone.empty());
  std::vector<std::size_t> sizes;
  for (const runs::Places& call : calls.together) {
    sizes.push_back(call.size());
    for (const std::size_t point : call) {
      EXPECT_EQ(point % 2, call.front() % 2) << "one length to a call";
    }
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{256, 44, 256, 44}));
}

TEST_F(SolveTest, TheExpectedCostIsThatOfTheSweepNotOfItsFirstPoint) {
  plan_for({frictionless_first});
  const double first = expected_solving_cost(plan_->experiment(0).plant);
  const double other = expected_solving_cost(plan_->experiment(1).plant);
  ASSERT_GT(first, 3.0 * other);
  EXPECT_NEAR(expected_solving_cost(*plan_, plan_->all()), 0.2 * first + 0.8 * other, 0.1 * first);
}

}  // namespace
}  // namespace sonoglide::sweep::solve_test
