#include "firmware/encoding/little_endian.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace sonoglide::encoding::little_endian_test {
namespace {

// Each byte has its own weight, and the bytes behind the number do not count.
TEST(LittleEndian, TheFirstByteIsTheLowest) {
  constexpr std::array<std::uint8_t, 5> bytes{0x81, 0x92, 0xA3, 0xB4, 0xC5};
  EXPECT_EQ(get_little_endian<std::uint8_t>(bytes.data()), 0x81U);
  EXPECT_EQ(get_little_endian<std::uint16_t>(bytes.data()), 0x9281U);
  EXPECT_EQ(get_little_endian<std::uint32_t>(bytes.data()), 0xB4A39281U);
  EXPECT_EQ(get_little_endian<std::int32_t>(bytes.data()), -0x4B5C6D7F);
}

}  // namespace
}  // namespace sonoglide::encoding::little_endian_test
