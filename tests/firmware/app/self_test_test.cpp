/// Bits of an image that have flipped.
#include "firmware/app/self_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware/encoding/crc32.hpp"

namespace sonoglide::app::self_test_test {
namespace {

/// The shape of hal::StoredImage, which is an address of a board.
struct Image {
  const std::uint8_t* begin;
  const std::uint8_t* end;
  std::uint32_t checksum;
};

std::vector<std::uint8_t> some_bytes(std::size_t size) {
  std::minstd_rand random(3);
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(random() >> 8);
  }
  return bytes;
}

bool passes(const std::vector<std::uint8_t>& bytes, std::uint32_t checksum) {
  return ImageTest(Image{bytes.data(), bytes.data() + bytes.size(), checksum}).passed();
}

TEST(ImageTestTest, AnyBitThatFlipsFails) {
  std::vector<std::uint8_t> bytes = some_bytes(1000);
  const std::uint32_t checksum = encoding::crc32(bytes.data(), bytes.size());
  EXPECT_TRUE(passes(bytes, checksum));
  for (std::uint8_t& byte : bytes) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      byte = static_cast<std::uint8_t>(byte ^ 1U << bit);
      ASSERT_FALSE(passes(bytes, checksum));
      byte = static_cast<std::uint8_t>(byte ^ 1U << bit);
    }
  }
  for (unsigned bit = 0; bit < 32; ++bit) {
    EXPECT_FALSE(passes(bytes, checksum ^ 1U << bit));
  }
}

TEST(ImageTestTest, AnImageInWhichNoBuildHasPutAChecksumFails) {
  EXPECT_FALSE(passes(some_bytes(1000), 0));
}

TEST(ImageTestTest, FlashThatWasErasedBehindAHalfLoadedImageFails) {
  std::vector<std::uint8_t> bytes = some_bytes(1000);
  const std::uint32_t checksum = encoding::crc32(bytes.data(), bytes.size());
  for (std::size_t from = 0; from < bytes.size(); from += 100) {
    std::vector<std::uint8_t> half = bytes;
    std::fill(half.begin() + static_cast<std::ptrdiff_t>(from), half.end(), std::uint8_t{0xFF});
    EXPECT_FALSE(passes(half, checksum)) << from;
    EXPECT_FALSE(passes(half, 0xFFFFFFFFU)) << from;
  }
}

}  // namespace
}  // namespace sonoglide::app::self_test_test
