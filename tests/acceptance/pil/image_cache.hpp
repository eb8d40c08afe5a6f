/// A place for the images that the program builds.
#pragma once

#include <cstdlib>

namespace sonoglide::acceptance {

/// Lets the programs that this process starts keep their images in the build folder.
inline void use_image_cache() {
  setenv("XDG_CACHE_HOME", SONOGLIDE_IMAGE_CACHE, 1);
}

}  // namespace sonoglide::acceptance
