#include "host_sim/studies/robust/study.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace sonoglide::robust::row_test {
namespace {

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(RobustRowTest, KeepsEveryBit) {
  EXPECT_TRUE(rc::check([](std::size_t place, double a, double b, std::uint64_t hash) {
    Record record{place, {}};
    record.row.overshoot = a;
    record.row.deviation = -b;
    record.row.unsettled = 3;
    record.row.limits = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 11);
    record.row.faults = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 25);
    record.row.trace_hash = hash;
    record.row.status = *rc::gen::element<std::string>("ok", "solver: at 1 s, \"x\" 2 m: why");
    const auto read = long_work::parse_record<PlantRow>(record_text(record));
    RC_ASSERT(read.has_value());
    RC_ASSERT(read->point == place);
    RC_ASSERT(same_bits(read->row.overshoot, a));
    RC_ASSERT(same_bits(read->row.deviation, -b));
    RC_ASSERT(same_bits(read->row.ripple, PlantRow::undefined));
    RC_ASSERT(read->row.unsettled == 3);
    RC_ASSERT(read->row.limits == record.row.limits);
    RC_ASSERT(read->row.faults == record.row.faults);
    RC_ASSERT(read->row.trace_hash == hash);
    RC_ASSERT(read->row.status == record.row.status);
  }));
  for (const char* text : {"", "1", "1 0 0 0 0 0 0 0 0 0 ", "1 0 0 0 0 0 0 9999999 0 0 ok"}) {
    EXPECT_FALSE(long_work::parse_record<PlantRow>(text).has_value()) << text;
  }
}

report::StepMetrics step(std::optional<double> settling_time_s, double steady_error,
                         double ripple) {
  report::StepMetrics metrics;
  metrics.settling_time_s = settling_time_s;
  metrics.overshoot = 0.25 * ripple;
  metrics.steady_error = steady_error;
  metrics.ripple = ripple;
  return metrics;
}

TEST(RowTest, HasTheWorstOfItsSteps) {
  const PlantRow row = row_of({step(1e-3, -0.02, 0.01), step(2e-3, 0.01, 0.03)}, {});
  EXPECT_EQ(row.settling_time_s, 2e-3);
  EXPECT_EQ(row.steady_error, 0.02);
  EXPECT_EQ(row.ripple, 0.03);
  EXPECT_DOUBLE_EQ(row.deviation, 0.04);
  EXPECT_FALSE(row.failed());
}

TEST(RowTest, FailsByAStepThatNeverSettlesByAFaultAndWithoutAResult) {
  const PlantRow slow = row_of({step(std::nullopt, 0.0, 0.1), step(2e-3, 0.0, 0.0)}, {});
  EXPECT_TRUE(std::isnan(slow.settling_time_s));
  EXPECT_EQ(slow.unsettled, 1U);
  EXPECT_TRUE(slow.failed());

  loop::ControlRecord control;
  control.faults.push_back({1e-3, control::Fault::measurement_stuck});
  const PlantRow faulty = row_of({step(1e-3, 0.0, 0.0)}, control);
  EXPECT_TRUE(faulty.failed());
  EXPECT_EQ(fault_names(faulty), std::vector<std::string>{"measurement_stuck"});

  const PlantRow none = failed_row("solver:\nbroken");
  EXPECT_EQ(none.status, "solver: broken");
  EXPECT_TRUE(none.failed());
  EXPECT_GT(none.badness(), slow.badness());
  EXPECT_GT(slow.badness(), row_of({step(1e-3, 0.9, 0.9)}, {}).badness());
}

TEST(RowTest, NamesItsLimits) {
  report::StepMetrics limited = step(1e-3, 0.0, 0.0);
  limited.limit = control::Limit::actuator;
  report::StepMetrics other = limited;
  other.limit = control::Limit::mismatch;
  const PlantRow row = row_of({limited, other, step(1e-3, 0.0, 0.0)}, {});
  EXPECT_EQ(limit_names(row), (std::vector<std::string>{"actuator", "mismatch"}));
  EXPECT_FALSE(row.failed()) << "a limit by itself is no failure";
}

}  // namespace
}  // namespace sonoglide::robust::row_test
