/// Attribution of values and saturations to named signals.

#include "firmware/numeric/signal_ledger.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "firmware/numeric/fixed.hpp"

namespace sonoglide::numeric::signal_ledger_test {
namespace {

struct Force {
  static constexpr const char* name = "force";
};
struct Speed {
  static constexpr const char* name = "speed";
};

using Number = Q31<Counting>;

TEST(SignalLedgerTest, ChargesSaturationsToTheNextSignalObserved) {
  SignalLedger ledger;
  const LedgerScope scope(ledger);
  const auto clamped = Number::largest() + Number::largest();
  static_cast<void>(Number::lowest() + Number::lowest());
  EXPECT_EQ(ledger.pending_saturations, 2U);
  EXPECT_EQ(observe<Force>(clamped), clamped);
  observe<Speed>(Number::from_real(-0.25));
  static_cast<void>(-Number::lowest());
  observe<Force>(Number::from_real(-0.5));

  ASSERT_EQ(ledger.size, 2U);
  const SignalRecord* force = ledger.find("force");
  ASSERT_NE(force, nullptr);
  EXPECT_EQ(force->observations, 2U);
  EXPECT_EQ(force->saturations, 3U);
  EXPECT_EQ(force->smallest, -0.5);
  EXPECT_EQ(force->largest, Number::largest().to_real());
  const SignalRecord* speed = ledger.find("speed");
  ASSERT_NE(speed, nullptr);
  EXPECT_EQ(speed->observations, 1U);
  EXPECT_EQ(speed->saturations, 0U);
  EXPECT_EQ(speed->smallest, -0.25);
  EXPECT_EQ(speed->largest, -0.25);
  EXPECT_EQ(ledger.find("spee"), nullptr);
  EXPECT_EQ(ledger.total_saturations(), 3U);
}

TEST(SignalLedgerTest, ScopesNestAndLeaveNothingAttached) {
  SignalLedger outer;
  SignalLedger inner;
  {
    const LedgerScope outer_scope(outer);
    {
      const LedgerScope inner_scope(inner);
      observe<Force>(Number());
    }
    observe<Speed>(Number());
  }
  observe<Force>(Number());
  EXPECT_EQ(attached_ledger, nullptr);
  EXPECT_EQ(inner.size, 1U);
  EXPECT_NE(inner.find("force"), nullptr);
  EXPECT_EQ(outer.size, 1U);
  EXPECT_NE(outer.find("speed"), nullptr);
}

TEST(SignalLedgerTest, LosesNoSaturationWhenFull) {
  SignalLedger ledger;
  std::array<std::string, SignalLedger::capacity + 1> names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = "signal " + std::to_string(i);
    ledger.pending_saturations = 1;
    ledger.record(names[i].c_str(), 0.0);
  }
  EXPECT_EQ(ledger.size, SignalLedger::capacity);
  EXPECT_EQ(ledger.unplaced_observations, 1U);
  EXPECT_EQ(ledger.unplaced_saturations, 1U);
  EXPECT_EQ(ledger.total_saturations(), names.size());
}

TEST(SignalLedgerTest, OtherScalarsPassUnobserved) {
  SignalLedger ledger;
  const LedgerScope scope(ledger);
  static_assert(observe<Force>(1.5) == 1.5);
  static_assert(observe<Force>(1.5F) == 1.5F);
  static_assert(observe<Force>(Q31<Saturating>::from_real(0.5)).to_real() == 0.5);
  EXPECT_EQ(ledger.size, 0U);
}

TEST(SignalLedgerTest, ASignalIsOneByTheTextOfItsName) {
  SignalLedger ledger;
  const std::string once = "force";
  const std::string again = "force";
  ledger.record(once.c_str(), -0.5);
  ledger.record(again.c_str(), 0.25);
  ASSERT_EQ(ledger.size, 1U);
  EXPECT_EQ(ledger.signals[0].smallest, -0.5);
  EXPECT_EQ(ledger.signals[0].largest, 0.25);
}

}  // namespace
}  // namespace sonoglide::numeric::signal_ledger_test
