/// A sweep whose first point is unlike the others.

#include "host_sim/studies/sweep/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
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
  std::map<std::size_t, std::string> records(const std::vector<Points>& calls) const {
    std::map<std::size_t, std::string> found;
    for (const Points& call : calls) {
      (*solve_)(call, [&](const std::vector<Record>& finished) {
        for (const Record& record : finished) {
          found[record.point] = record_text(record);
        }
      });
    }
    return found;
  }

  ScratchScene scratch_{open_loop};
  long_work::Progress nobody_;
  long_work::Pace pace_{nobody_};
  std::optional<Plan> plan_;
  std::optional<Solve> solve_;
  Points all_;
};

TEST_F(SolveTest, LanesTakeTheOthersTogether) {
  plan_for({frictionless_first});
  EXPECT_EQ(solve_->calls(all_), (std::vector<Points>{{0}, {1, 2, 3, 4}}));
  const std::map<std::size_t, std::string> together = records(solve_->calls(all_));
  EXPECT_EQ(together.at(0), record_text({0, solve_scalar_point(plan_->scene(0))}));
  EXPECT_EQ(together, records({{0}, {1}, {2}, {3}, {4}})) << "to the bit what each is alone";
}

TEST_F(SolveTest, PointsOfOneLengthGoTogetherWhereverTheyAre) {
  plan_for({"friction.coefficient=0.1:0.2:300", "run.duration_periods=30:31:2"});
  const std::vector<Points> calls = solve_->calls(all_);
  ASSERT_EQ(calls.size(), 4U);
  std::vector<std::size_t> sizes;
  Points seen;
  for (const Points& call : calls) {
    sizes.push_back(call.size());
    seen.insert(seen.end(), call.begin(), call.end());
    for (const std::size_t point : call) {
      EXPECT_EQ(point % 2, call.front() % 2) << "one length to a call";
    }
  }
  std::sort(sizes.begin(), sizes.end());
  EXPECT_EQ(sizes, (std::vector<std::size_t>{44, 44, 256, 256}));
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, all_);
}

TEST_F(SolveTest, TheExpectedCostIsThatOfTheSweepNotOfItsFirstPoint) {
  plan_for({frictionless_first});
  const double first = expected_solving_cost(plan_->scene(0));
  const double other = expected_solving_cost(plan_->scene(1));
  ASSERT_GT(first, 3.0 * other);
  EXPECT_NEAR(expected_solving_cost(*plan_, plan_->all()), 0.2 * first + 0.8 * other, 0.1 * first);
}

}  // namespace
}  // namespace sonoglide::sweep::solve_test
