#include "host_sim/studies/sweep/row.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstring>
#include <string>

namespace sonoglide::sweep::row_test {
namespace {

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(SweepRowTest, KeepsEveryBit) {
  EXPECT_TRUE(rc::check("read is written", [](std::size_t point, double a, double b, double c) {
    Record record{point, {}};
    record.row.friction_ratio_whole_run = a;
    record.row.friction_ratio_window = -b;
    record.row.ripple = c;
    record.row.texture_lag_deg = -c;
    record.row.limit = *rc::gen::element(control::Limit::none, control::Limit::speed_floor);
    record.row.fault =
        *rc::gen::element(control::Fault::none, control::Fault::measurement_implausible);
    record.row.status = *rc::gen::element<std::string>("ok", "solver: at 1 s, \"x\" 2 m: why");
    const auto read = long_work::parse_record<PointResult>(record_text(record));
    RC_ASSERT(read.has_value());
    RC_ASSERT(read->point == point);
    RC_ASSERT(same_bits(read->row.friction_ratio_whole_run, a));
    RC_ASSERT(same_bits(read->row.friction_ratio_window, -b));
    RC_ASSERT(same_bits(read->row.dissipation_ratio_window, PointResult::undefined));
    RC_ASSERT(same_bits(read->row.ripple, c));
    RC_ASSERT(same_bits(read->row.texture_lag_deg, -c));
    RC_ASSERT(read->row.limit == record.row.limit);
    RC_ASSERT(read->row.fault == record.row.fault);
    RC_ASSERT(read->row.status == record.row.status);
  }));
}

TEST(SweepRowTest, TextsOfAnotherFormAreRefused) {
  for (const char* text : {"", "1", "x 0 0 0 0 0 0 0 0 0 0 0 0 0 ok",
                           "1 0 0 0 0 0 0 0 0 0 0 0 0 99 ok", "1 0 0 0 0 0 0"}) {
    EXPECT_FALSE(long_work::parse_record<PointResult>(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace sonoglide::sweep::row_test
