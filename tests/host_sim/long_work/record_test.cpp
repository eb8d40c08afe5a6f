#include "host_sim/long_work/record.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstring>
#include <limits>
#include <string>

namespace sonoglide::long_work::record_test {
namespace {

TEST(SealedTest, NoTornOrDamagedLineIsTaken) {
  const std::string line = sealed("17 0 3ff0000000000000 ok");
  ASSERT_TRUE(unsealed(line).has_value());
  for (std::size_t length = 0; length < line.size(); ++length) {
    EXPECT_FALSE(unsealed(line.substr(0, length)).has_value()) << length;
  }
  for (std::size_t at = 0; at < line.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = line;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      EXPECT_FALSE(unsealed(damaged).has_value()) << at << ' ' << bit;
    }
  }
}

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(RecordNumbersTest, KeepEveryBit) {
  EXPECT_TRUE(rc::check([](double a, std::uint64_t n) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::string text = number_text(a) + number_text(n) + number_text(nan) + "rest of it";
    RecordNumbers numbers(text);
    RC_ASSERT(same_bits(numbers.real(), a));
    RC_ASSERT(numbers.whole() == n);
    RC_ASSERT(same_bits(numbers.real(), nan));
    RC_ASSERT(numbers.good() && numbers.rest() == "rest of it");
    numbers.whole();
    RC_ASSERT(!numbers.good());
  }));
}

}  // namespace
}  // namespace sonoglide::long_work::record_test
