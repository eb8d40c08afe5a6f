#include "firmware/encoding/decimal.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace sonoglide::encoding::decimal_test {
namespace {

std::string written(std::uint32_t value, int places) {
  std::array<char, most_decimal_characters> text{};
  return {text.data(), write_decimal(value, places, text.data())};
}

std::optional<std::uint32_t> read(const std::string& text, int places) {
  std::uint32_t value = 0;
  return read_decimal(text.data(), text.size(), places, value) ? std::optional(value)
                                                               : std::nullopt;
}

TEST(DecimalTest, WritesWithoutZerosAtTheEnd) {
  EXPECT_EQ(written(0, 0), "0");
  EXPECT_EQ(written(0, 6), "0");
  EXPECT_EQ(written(450000, 6), "0.45");
  EXPECT_EQ(written(1000000, 6), "1");
  EXPECT_EQ(written(5, 6), "0.000005");
  EXPECT_EQ(written(12340000, 6), "12.34");
  EXPECT_EQ(written(100, 0), "100");
  EXPECT_EQ(written(4294967295U, 0), "4294967295");
  EXPECT_EQ(written(4294967295U, 9), "4.294967295");
}

TEST(DecimalTest, ReadsUsualForms) {
  EXPECT_EQ(read("0.45", 6), 450000U);
  EXPECT_EQ(read(".5", 6), 500000U);
  EXPECT_EQ(read("1.", 6), 1000000U);
  EXPECT_EQ(read("0000000000001", 6), 1000000U);
  EXPECT_EQ(read("0.4500000000", 6), 450000U);
  EXPECT_EQ(read("12.0", 0), 12U);
  EXPECT_EQ(read("4294967295", 0), 4294967295U);
}

TEST(DecimalTest, RefusesTheRest) {
  for (const char* text :
       {"", ".", "-1", "+1", " 1", "1 ", "1e3", "0x1", "1.2.3", "nan", "0.1234567", "4294.967296",
        "4295", "999999", "99999999999999999999999999"}) {
    EXPECT_EQ(read(text, 6), std::nullopt) << text;
  }
  EXPECT_EQ(read("1.5", 0), std::nullopt);
  EXPECT_EQ(read("4294967296", 0), std::nullopt);
}

RC_GTEST_PROP(DecimalTest, ReadsWhatItWrote, (std::uint32_t value)) {
  const int places = *rc::gen::inRange(0, 10);
  RC_ASSERT(read(written(value, places), places) == std::optional(value));
}

// Against the library's own reading.
RC_GTEST_PROP(DecimalTest, WritesTheNumber, (std::uint32_t value)) {
  RC_ASSERT(std::stod(written(value, 6)) == value / 1e6);
}

RC_GTEST_PROP(DecimalTest, AnyTextIsReadOrRefused, (const std::string& text)) {
  const auto value = read(text, 6);
  if (value) {
    RC_ASSERT(std::stod("0" + text) == *value / 1e6);
  }
}

}  // namespace
}  // namespace sonoglide::encoding::decimal_test
