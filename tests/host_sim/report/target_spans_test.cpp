#include "host_sim/report/step_metrics.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "periods.hpp"

namespace sonoglide::report::target_spans_test {
namespace {

/// The span of each carrier period in turn.
std::vector<std::size_t> spans_of(const scene::Scene& scene) {
  SpanCursor cursor(scene);
  std::vector<std::size_t> found;
  for (const loop::Period& period : made_up_run(scene, [](int) { return 0.5; })) {
    found.push_back(cursor.span_of(period));
  }
  return found;
}

constexpr std::size_t none = SpanCursor::none;

TEST(SpanCursorTest, FindsTheSpanThatHoldsAPeriodFromEndToEnd) {
  EXPECT_EQ(spans_of(made_up_scene({{0.0, 0.4}, {2e-3, 0.5}, {4e-3, 0.6}}, 6e-3)),
            (std::vector<std::size_t>{0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(spans_of(made_up_scene({{0.0, 0.4}, {2.5e-3, 0.5}}, 4.4e-3)),
            (std::vector<std::size_t>{0, 0, none, 1, none}));
}

TEST(SpanCursorTest, LeavesOutCalibrationAndTheStepsThatItSwallows) {
  scene::Scene scene = made_up_scene({{0.0, 0.4}, {1e-3, 0.5}, {2e-3, 0.6}}, 5e-3);
  scene.controller->calibration_s = 3e-3;
  EXPECT_EQ(spans_of(scene), (std::vector<std::size_t>{none, none, none, 2, 2}));
}

TEST(SpanCursorTest, LeavesOutStepsShorterThanAPeriod) {
  EXPECT_EQ(spans_of(made_up_scene({{0.0, 0.4}, {1.2e-3, 0.5}, {1.4e-3, 0.6}}, 4e-3)),
            (std::vector<std::size_t>{0, none, 2, 2}));
}

}  // namespace
}  // namespace sonoglide::report::target_spans_test
