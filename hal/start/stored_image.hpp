/// An image as it is kept while there is no power, and the checksum that the build puts behind it.
#pragma once

#include <cstdint>

extern "C" {

/// In the shape of a section .gnu_debuglink, by which objcopy computes it.
struct ImageChecksum {
  char name[4];         ///< "crc"
  std::uint32_t crc32;  ///< of IEEE 802.3, of all that is stored before this
};

/// Filled in once the image is linked (tools/cmake/sonoglideChecksum.cmake). It stays where the image is kept.
[[gnu::section(".image_checksum")]] inline const ImageChecksum image_checksum{};

extern const std::uint8_t stored_begin[];  // address from loaded_sections.ld
}

namespace sonoglide::hal {

struct StoredImage {
  const std::uint8_t* begin;
  const std::uint8_t* end;  ///< behind what the checksum is of
  std::uint32_t checksum;   ///< 0 where no build has put one
};

/// Only an image that calls this has a checksum.
inline StoredImage stored_image() {
  // Through volatile: the compiler takes it for 0.
  const volatile std::uint32_t& checksum = image_checksum.crc32;
  return {stored_begin, reinterpret_cast<const std::uint8_t*>(&image_checksum), checksum};
}

}  // namespace sonoglide::hal
