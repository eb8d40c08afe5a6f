/// A sweep whose first point is unlike the others.

#include "host_sim/studies/sweep/solve.hpp"

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/host_sim/studies/sweep/scenes/base_scenes.hpp"
#include "tests/host_sim/studies/sweep/scenes/scratch_scene.hpp"

namespace sonoglide::sweep::solve_test {
namespace {

/// Without friction the lanes have nothing to solve.
const char* const frictionless_first = "friction.coefficient=0:0.2:5";

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
  const runs::ThreadLimit limit(2);
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
