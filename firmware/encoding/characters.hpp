/// A piece of text that is stored elsewhere.
#pragma once

#include <cstddef>

namespace sonoglide::encoding {

/// A text that is not owned and has no terminator.
struct Characters {
  const char* begin = nullptr;
  std::size_t size = 0;

  bool are(const char* word) const {
    for (std::size_t i = 0; i < size; ++i) {
      if (word[i] == '\0' || word[i] != begin[i]) {
        return false;
      }
    }
    return word[size] == '\0';
  }
};

}  // namespace sonoglide::encoding
