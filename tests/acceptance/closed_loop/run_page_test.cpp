/// The report of a real run in a real browser.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"
#include "tests/acceptance/page/browser.hpp"
#include "tests/acceptance/page/exercise.hpp"

namespace sonoglide::acceptance::run_page_test {
namespace {

struct Report {
  std::string scene;
  Settings settings;
  int panels;
  std::vector<std::string> headings;  ///< of tables and sections
};

const Report reports[] = {
    {"target_step",
     {},
     13,
     {"Target steps", "Run", "Course of the run", "Step to 0.4 at 0 ms", "Step to 0.6 at 2 ms",
      "Step to 0.5 at 4 ms", "End of the run"}},
    {"speed_reversal",
     {"controller.arithmetic=q31"},
     8,
     {"Target steps", "Run", "Fixed-point signals, per unit", "Course of the run",
      "Step to 0.5 at 0 ms", "End of the run"}},
    {"table_1_open_loop", {}, 7, {"Run", "Course of the run", "Start", "End of the run"}},
    {"damped_step",
     {"plant.stiffness_N_per_m=2.558e6", "friction.normal_force_N=40",
      "friction.contact_stiffness_N_per_m=11.4e6", "drive.max_force_amplitude_N=2200",
      "drive.bias_limit_N=12"},
     15,
     {"Course of the run", "Bias", "Vibration"}},
    // Of one carrier period there is no course.
    {"steady_open_loop", {}, 5, {"Run", "Start", "End of the run"}},
};

class RunPageTest : public testing::TestWithParam<Report> {
 protected:
  void SetUp() override { run_scene(folder_, GetParam().scene, GetParam().settings); }

  browser::Visit visit(const std::string& script = "") const {
    return browser::load(folder_.path() / "out/report.html", script);
  }
  static int count(const browser::Visit& visit, const std::string& name) {
    const std::string value = browser::body_attribute(visit.dom, name);
    return value.empty() ? -1 : std::stoi(value);
  }

  ScratchFolder folder_;
};

TEST_P(RunPageTest, DrawsEveryPanelAndStaysOffTheNetwork) {
  const browser::Visit seen = visit();
  EXPECT_EQ(count(seen, "data-panels"), GetParam().panels);
  EXPECT_EQ(count(seen, "data-drawn"), GetParam().panels);
  EXPECT_TRUE(seen.requests.empty()) << seen.requests.front();
  for (const std::string& heading : GetParam().headings) {
    EXPECT_NE(seen.dom.find(">" + heading + "<"), std::string::npos) << heading;
  }
}

TEST_P(RunPageTest, AnswersTheMouseOnEveryPanel) {
  const browser::Visit seen = visit(browser::exercise_script);
  for (const char* use :
       {"data-zoomed", "data-read", "data-panned", "data-reset", "data-followed"}) {
    EXPECT_EQ(count(seen, use), GetParam().panels) << use;
  }
}

INSTANTIATE_TEST_SUITE_P(Reports, RunPageTest, testing::ValuesIn(reports),
                         [](const auto& report) { return report.param.scene; });

}  // namespace
}  // namespace sonoglide::acceptance::run_page_test
