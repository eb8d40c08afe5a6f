/// The one word of a console that never waits.
#pragma once

#include <cstdint>

namespace sonoglide::app {

/// Finds lines that end with "stop", whatever stands before it: a fragment, noise, or a line too
/// long to be taken. Blanks may follow.
class StopWord {
 public:
  /// @return whether the character ends such a line.
  bool take(char character) {
    constexpr char word[] = "stop";
    constexpr std::uint8_t whole = sizeof word - 1;
    if (character == '\r' || character == '\n') {
      const bool stop = matched_ == whole;
      matched_ = 0;
      return stop;
    }
    if (matched_ == whole && character == ' ') {
      return false;
    }
    if (matched_ < whole && character == word[matched_]) {
      ++matched_;
    } else {
      matched_ = character == word[0] ? 1 : 0;
    }
    return false;
  }

 private:
  std::uint8_t matched_ = 0;  ///< letters of the word
};

}  // namespace sonoglide::app
