/// Figures of a step against closed forms of linear systems.
#include "host_sim/boards/unit/step_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/boards/unit/trace_page.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::unit::step_response_test {
namespace {

constexpr double step_s = app::carrier_period_s;
constexpr std::uint16_t steps_before = 100;
constexpr std::uint32_t running = static_cast<std::uint32_t>(control::State::running);
constexpr std::uint32_t settled = running | static_cast<std::uint32_t>(control::Settling::settled)
                                                << 24;
const UnitScales scales(app::full_scales);

/// From 0.01 N to 0.03 N, along a progress from 0 to 1 over the time since the new target.
RecordedStep step_along(std::size_t steps, const std::function<double(double)>& progress,
                        double ripple_N = 0.0) {
  RecordedStep step{{}, true};
  RecordedTrace& trace = step.trace;
  trace.state.before = steps_before;
  for (std::size_t i = 0; i < steps; ++i) {
    const double since_s = (static_cast<double>(i) - steps_before) * step_s;
    const double force_N = 0.01 + 0.02 * (since_s < 0.0 ? 0.0 : progress(since_s)) +
                           (i % 2 == 0 ? ripple_N : -ripple_N);
    link::TraceRecord record{};
    record.index = static_cast<std::uint16_t>(i);
    record.friction_force =
        static_cast<std::int32_t>(std::lround(force_N / app::full_scales[0].value * 0x1p31));
    record.target = i < steps_before ? 200'000 : 600'000;
    record.codes = settled;
    trace.records.push_back(record);
  }
  trace.state.records = static_cast<std::uint16_t>(steps);
  return step;
}

TEST(StepResponse, OfTheFirstOrderIsItsTimeConstant) {
  constexpr double tau_s = 50 * step_s;
  const auto response = step_response(
      step_along(2000, [](double t_s) { return 1.0 - std::exp(-t_s / tau_s); }), scales);
  EXPECT_NEAR(response.before_N, 0.01, 1e-9);
  EXPECT_NEAR(response.after_N, 0.03, 1e-9);
  ASSERT_TRUE(response.course);
  EXPECT_NEAR(response.course->rise_s, tau_s * std::log(9.0), 1.01 * step_s);
  EXPECT_NEAR(*response.course->settling_s, tau_s * std::log(20.0), 1.01 * step_s);
  EXPECT_NEAR(response.course->overshoot, 0.0, 1e-6);
}

TEST(StepResponse, OfTheSecondOrderOvershootsByItsDamping) {
  constexpr double damping = 0.3;
  constexpr double rate_per_s = 0.05 / step_s;
  const double damped_per_s = rate_per_s * std::sqrt(1.0 - damping * damping);
  const auto response = step_response(
      step_along(2000,
                 [&](double t_s) {
                   return 1.0 -
                          std::exp(-damping * rate_per_s * t_s) *
                              (std::cos(damped_per_s * t_s) +
                               damping * rate_per_s / damped_per_s * std::sin(damped_per_s * t_s));
                 }),
      scales);
  ASSERT_TRUE(response.course);
  EXPECT_NEAR(response.course->overshoot,
              std::exp(-tests::two_pi / 2.0 * damping / std::sqrt(1.0 - damping * damping)), 1e-3);
}

TEST(StepResponse, WhatTheRippleHidesHasNoCourse) {
  const auto at_once = [](double) { return 1.0; };
  EXPECT_TRUE(step_response(step_along(400, at_once, 0.0009), scales).course);
  const auto hidden = step_response(step_along(400, at_once, 0.0011), scales);
  EXPECT_FALSE(hidden.course);
  EXPECT_NE(text_of(hidden).find(", which hides the course of this step"), std::string::npos);
}

TEST(StepResponse, AForceThatStaysHasNoCourse) {
  const auto response = step_response(step_along(2000, [](double) { return 0.0; }), scales);
  EXPECT_FALSE(response.course);
  EXPECT_EQ(text_of(response), "the friction force stays at 10 mN, ripple 0 N");
}

TEST(StepResponse, WhatTheTraceIsTooShortForIsSaid) {
  // Its last quarter begins 6 % below the level that is its mean, and ripples by less than 5 %.
  const auto slow = [](double t_s) { return t_s < 280 * step_s ? 0.92 : 1.0; };
  const auto response = step_response(step_along(steps_before + 300, slow), scales);
  ASSERT_TRUE(response.course);
  EXPECT_FALSE(response.course->settling_s);
  EXPECT_NE(text_of(response).find("not within 5 % of the step before the trace ends"),
            std::string::npos)
      << text_of(response);
}

// A level that is no target is not told as one.
TEST(StepResponse, SaysWhereTheLoopEnds) {
  RecordedStep step = step_along(400, [](double) { return 1.0; });
  EXPECT_EQ(text_of(step_response(step, scales)).find("settled"), std::string::npos);
  step.settled_before = false;
  step.trace.records.back().codes = static_cast<std::uint32_t>(control::State::limited) |
                                    static_cast<std::uint32_t>(control::Limit::actuator) << 8;
  const std::string told = text_of(step_response(step, scales));
  EXPECT_NE(told.find("; the loop had not settled before; at its end the loop is limited, limit "
                      "actuator, settling pending"),
            std::string::npos)
      << told;
}

TEST(TracePage, ShowsWhatWasReadAndAnswered) {
  const RecordedStep step = step_along(400, [](double) { return 1.0; });
  const output::Page page = page_of(step.trace, scales, step_response(step, scales), "");
  ASSERT_EQ(page.sections.size(), 1U);
  const auto& charts = page.sections[0].charts;
  ASSERT_EQ(charts.size(), 4U);
  EXPECT_EQ(charts[0].y_axis.label, "Friction force [N]");
  EXPECT_EQ(charts[0].x.front(), -100.0 * step_s);
  EXPECT_EQ(charts[0].x[steps_before], 0.0);
  EXPECT_NEAR(charts[0].curves[0].y[steps_before], 0.03, 1e-9);
  EXPECT_EQ(charts[1].y_axis.label, "Target friction ratio [-]");
  EXPECT_EQ(charts[1].curves[0].y[steps_before], 0.6);
  EXPECT_EQ(page.sections[0].tables[0].rows.size(), 1U);
  EXPECT_EQ(page.notes.size(), 1U);
}

}  // namespace
}  // namespace sonoglide::unit::step_response_test
