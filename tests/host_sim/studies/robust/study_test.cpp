#include "host_sim/studies/robust/study.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "host_sim/studies/robust/report.hpp"
#include "robust_scenes.hpp"

namespace sonoglide::robust::study_test {
namespace {

namespace fs = std::filesystem;

class RobustStudyTest : public testing::Test {
 protected:
  RobustStudyTest() { fs::create_directories(folder_); }
  ~RobustStudyTest() override { fs::remove_all(folder_); }

  /// Both tables.
  std::string tables(const Task& task, const Study& study) const {
    std::ostringstream text;
    write_samples(text, task, study);
    write_search(text, task, study);
    return text.str();
  }
  Study solve(const Task& task, std::size_t threads = 0) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    threads == 0 ? 2 : threads);
    Solver solver(task, folder_, "test");
    Study study = solver.solve({});
    if (threads != 0) {
      solver.remove_journal();
    }
    return study;
  }
  fs::path journal() const { return folder_ / "robust.journal"; }

  fs::path folder_ = fs::path(testing::TempDir()) / ("robust_" + std::to_string(getpid()));
};

TEST_F(RobustStudyTest, RowsAreTheSameForAnyNumberOfThreads) {
  const Task task({"s.toml", uncertain_step}, {}, {40, 60, 3});
  const std::string one = tables(task, solve(task, 1));
  EXPECT_EQ(one, tables(task, solve(task, 2)));
  EXPECT_EQ(one, tables(task, solve(task, 4)));
}

/// The journal cut at any of its lines, or within one, gives the same rows again.
TEST_F(RobustStudyTest, GoesOnWhereItWasKilled) {
  const Task task({"s.toml", uncertain_step}, {"run.duration_s=2e-4"}, {12, 40, 3});
  const std::string whole = tables(task, solve(task));
  std::ifstream stream(journal(), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_GT(lines, 20);
  for (std::size_t length = 0; length <= text.size(); length += text.size() / 9) {
    std::ofstream(journal(), std::ios::binary) << text.substr(0, length);
    const auto kept =
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length), '\n');
    Solver solver(task, folder_, "test");
    EXPECT_EQ(solver.found_finished(), kept == 0 ? 0U : static_cast<std::size_t>(kept) - 1);
    EXPECT_EQ(tables(task, solver.solve({})), whole) << length;
  }
  const Task other({"s.toml", uncertain_step}, {"run.duration_s=2e-4"}, {12, 40, 4});
  EXPECT_THROW(Solver(other, folder_, "test"), long_work::ForeignJournal);
}

/// The ripple that the notch leaves grows with the error of the stiffness, to either side: the worst
/// plant is at an end, which a grid over the tolerance tells.
TEST_F(RobustStudyTest, FindsTheWorstPlantInATenthOfTheRunsOfRandomSampling) {
  const std::string text = target_step + "[tolerance]\n\"plant.stiffness_N_per_m\" = 0.04\n";
  const Task task({"s.toml", text}, {}, {16, 48, 1});
  const Study study = solve(task, 2);
  EXPECT_EQ(study.worst.found_by, "search");

  double highest = 0.0;
  double at = 0.0;
  for (int i = 0; i <= 80; ++i) {
    const double stiffness = 133e6 * (0.96 + 0.001 * i);
    const Task single({"s.toml", text}, {}, {1, 0, 1});
    const double found = run_plants({single.plant({stiffness})}, single.design()).front().deviation;
    at = found > highest ? stiffness : at;
    highest = std::max(highest, found);
  }
  EXPECT_TRUE(at == 133e6 * 0.96 || at == 133e6 * (0.96 + 0.001 * 80)) << at;
  EXPECT_NEAR(study.worst.factors.front() / at, 1.0, 1e-3 * 0.04);
  EXPECT_GE(study.worst.row.deviation, 0.999 * highest);
  // Within 1e-3 of its half width from that end comes one random plant of 2000.
  EXPECT_LE(study.samples.size() + study.search.size(), 200U);
}

TEST_F(RobustStudyTest, ItsFiguresAreThoseOfItsRows) {
  const Task task({"s.toml", uncertain_step}, {"run.duration_s=5e-4"}, {50, 20, 7});
  const Study study = solve(task, 2);
  const nlohmann::ordered_json json = to_json(task, study);
  EXPECT_EQ(json["samples"], 50);
  EXPECT_EQ(json["failures"], study.failures());
  std::vector<double> ripples;
  for (const PlantRow& row : study.samples) {
    ripples.push_back(row.ripple);
    EXPECT_LE(row.badness(), study.worst.row.badness());
  }
  std::sort(ripples.begin(), ripples.end());
  EXPECT_EQ(json["ripple"]["median"], ripples[24]);
  EXPECT_EQ(json["ripple"]["p95"], ripples[47]);
  EXPECT_EQ(json["ripple"]["p99"], ripples[49]);
  EXPECT_EQ(json["ripple"]["worst"], ripples[49]);
  EXPECT_EQ(json["worst"]["factors"].size(), 3U);
  EXPECT_EQ(json["worst"]["ripple"], study.worst.row.ripple);
}

}  // namespace
}  // namespace sonoglide::robust::study_test
