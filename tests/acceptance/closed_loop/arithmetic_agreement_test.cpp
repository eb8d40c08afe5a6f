/// Fixed point against double precision, carrier period by carrier period.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::arithmetic_agreement_test {
namespace {

/// Largest difference of the friction ratio in any carrier period.
double difference(const std::string& name, const std::string& arithmetic,
                  std::vector<std::string> settings = {}) {
  settings.emplace_back();
  const auto run = [&](const std::string& chosen) {
    settings.back() = "controller.arithmetic=" + chosen;
    return loop::run_logged(
        experiment::read_file(SONOGLIDE_SCENES "/" + name + ".toml", settings).plant);
  };
  const loop::LoggedRun exact = run("float64");
  const loop::LoggedRun rounded = run(arithmetic);
  EXPECT_EQ(rounded.periods.size(), exact.periods.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < exact.periods.size(); ++i) {
    largest = std::max(
        largest, std::abs(rounded.periods[i].friction_ratio - exact.periods[i].friction_ratio));
  }
  return largest;
}

class ArithmeticAgreementTest : public testing::TestWithParam<std::string> {};

TEST_P(ArithmeticAgreementTest, FixedPointIsWithinTwoThousandthsOfDouble) {
  EXPECT_LE(difference(GetParam(), "q31"), 0.002);
}

TEST_P(ArithmeticAgreementTest, SixteenBitsAreWithinTwoThousandthsOfDouble) {
  EXPECT_LE(difference(GetParam(), "q15"), 0.002);
}

TEST_P(ArithmeticAgreementTest, SinglePrecisionIsWithinTwoThousandthsOfDouble) {
  EXPECT_LE(difference(GetParam(), "float32"), 0.002);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ArithmeticAgreementTest,
                         testing::Values("target_step", "model_error", "noisy_sensor",
                                         "unreachable_target", "speed_ramp", "speed_reversal",
                                         "stop_and_start"),
                         [](const auto& scene) { return scene.param; });

// Undamped, the natural mode keeps whatever the rounding of 16 bits stirs up in it.
TEST(ArithmeticAgreementTest, SixteenBitsStayThereOverALongRun) {
  EXPECT_LE(difference("target_step", "q15",
                       {"run.duration_s=0.3", "run.record=[]", "solver.method=event_gauss",
                        "solver.tolerance=1e-8"}),
            0.0005);
}

TEST(ArithmeticAgreementTest, FixedPointSaturatesNowhereInside) {
  for (const char* name : {"target_step", "model_error", "noisy_sensor", "unreachable_target",
                           "speed_ramp", "speed_reversal", "stop_and_start"}) {
    const loop::RunResult result =
        loop::run(experiment::read_file(SONOGLIDE_SCENES "/" + std::string(name) + ".toml",
                                        {"controller.arithmetic=q31"})
                      .plant);
    ASSERT_FALSE(result.control->signals.empty());
    for (const numeric::SignalRecord& signal : result.control->signals) {
      EXPECT_EQ(signal.saturations, 0U) << name << ' ' << signal.name;
    }
  }
}

}  // namespace
}  // namespace sonoglide::arithmetic_agreement_test
