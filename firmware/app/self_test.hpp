/// What a unit tests of itself before anybody can start its drive.
#pragma once

#include <cstdint>

#include "firmware/encoding/crc32.hpp"

namespace sonoglide::app {

/// Of a unit that tests nothing.
struct NoSelfTest {
  static constexpr bool passed() { return true; }
};

/// Whether the image in flash is the one that was built. A bit that has flipped shows, and an image that was loaded in
/// part. Damage to the code that runs until then may also hang the unit, with its drive as after a reset.
class ImageTest {
 public:
  /// To be made before the watchdog runs: it takes some 25 clocks of a Cortex-M0 for a byte.
  /// @param image  see hal::StoredImage
  template <class Image>
  explicit ImageTest(const Image& image)
      : passed_(is_whole(image.begin, image.end, image.checksum)) {}

  bool passed() const { return passed_; }

 private:
  [[gnu::cold, gnu::noinline]] static bool is_whole(const std::uint8_t* at, const std::uint8_t* end,
                                                    std::uint32_t expected) {
    encoding::Crc32 checksum;
    for (; at != end; ++at) {
      checksum.add(*at);
    }
    return checksum.value() == expected;
  }

  bool passed_;
};

}  // namespace sonoglide::app
