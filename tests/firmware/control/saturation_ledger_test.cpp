/// Where a signal does leave its range, the saturation is counted under that signal's name.

#include <gtest/gtest.h>

#include "closed_loop.hpp"
#include "firmware/numeric/signal_ledger.hpp"
#include "scalars.hpp"

namespace sonoglide::control::saturation_ledger_test {
namespace {

using Counted = numeric::Q31<numeric::Counting>;

std::uint64_t saturations(const numeric::SignalLedger& ledger, const char* name) {
  const numeric::SignalRecord* const record = ledger.find(name);
  return record == nullptr ? 0 : record->saturations;
}

class SaturationLedger : public testing::Test {
 protected:
  numeric::SignalLedger ledger_;
  numeric::LedgerScope scope_{ledger_};
};

TEST_F(SaturationLedger, StaysEmptyInNormalOperation) {
  ClosedLoop<FullParts<Counted>> loop({});
  loop.set_target(0.4);
  loop.run(500);
  EXPECT_EQ(ledger_.total_saturations(), 0U);
  for (const char* name : {"measured_ratio", "ratio_error", "ratio_integral", "commanded_ratio",
                           "requested_amplitude", "shaped_amplitude"}) {
    ASSERT_NE(ledger_.find(name), nullptr) << name;
    EXPECT_GT(ledger_.find(name)->observations, 400U) << name;
  }
}

TEST_F(SaturationLedger, CountsAMeasuredRatioBeyondTwo) {
  Design design;
  design.friction_force = 0.25;
  ClosedLoop<ShapedParts<Counted>> loop(design);
  loop.set_target(0.4);
  loop.answer({scaled<Counted>(0.6), scaled<Counted>(0.1), Quality::good});
  EXPECT_EQ(saturations(ledger_, "measured_ratio"), 1U);
  EXPECT_EQ(ledger_.total_saturations(), 1U);
  EXPECT_EQ(ledger_.find("measured_ratio")->largest, Counted::largest().to_real());
}

// Friction against the sliding, by more than its limit: base 2 holds errors below 2 only.
TEST_F(SaturationLedger, CountsARatioErrorBeyondTwo) {
  ClosedLoop<ShapedParts<Counted>> loop({});
  loop.set_target(0.8);
  loop.answer({scaled<Counted>(-0.7), scaled<Counted>(0.1), Quality::good});
  EXPECT_EQ(saturations(ledger_, "ratio_error"), 1U);
  EXPECT_EQ(ledger_.total_saturations(), 1U);
}

// Requests of 0.9, 0.1 and 0.9 of full drive, one period each: the first and the last meet in the
// outer taps.
TEST_F(SaturationLedger, CountsAShapedAmplitudeBeyondFullDriveAndTheCommandNamesIt) {
  ClosedLoop<ShapedParts<Counted>> counted({});
  ClosedLoop<ShapedParts<double>> exact({});
  Limit exact_limit = Limit::none;
  Limit counted_limit = Limit::none;
  for (const double target : {0.11, 0.95, 0.11}) {
    counted.set_target(target);
    exact.set_target(target);
    counted_limit = counted.step().limit;
    exact_limit = exact.step().limit;
  }
  EXPECT_GT(saturations(ledger_, "shaped_amplitude"), 0U);
  EXPECT_EQ(exact_limit, Limit::actuator);
  EXPECT_EQ(counted_limit, Limit::actuator);
}

// Only where the speed changes by a good part of full speed within one period.
TEST_F(SaturationLedger, CountsAForeseenSpeedBeyondFullSpeed) {
  ClosedLoop<ShapedParts<Counted>> loop({});
  loop.set_target(0.4);
  loop.step(0.1);
  EXPECT_EQ(ledger_.total_saturations(), 0U);
  loop.step(0.9);
  EXPECT_GT(ledger_.total_saturations(), 0U);
  EXPECT_EQ(saturations(ledger_, "measured_ratio"), 0U);
}

}  // namespace
}  // namespace sonoglide::control::saturation_ledger_test
