/// What is typed while a console answers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sonoglide::app {

/// Keeps up to 62 characters in their order. A line that does not fit is never taken for a shorter
/// one: `spoilt` stands before its end, for which two places are kept free.
class TypedAhead {
 public:
  static constexpr char spoilt = '\x18';

  void put(char character) {
    const bool ends_line = character == '\r' || character == '\n';
    if (ends_line && !line_begun_) {
      return;  // an empty line, or the second character of a line's end
    }
    line_begun_ = !ends_line;
    if (!spoiling_ && count_ + 2 < characters_.size()) {
      append(character);
      return;
    }
    spoiling_ = line_begun_;
    // Where not even the end fits, that of the spoilt line before it is still there to be told.
    if (!spoiling_ && count_ + 2 <= characters_.size()) {
      append(spoilt);
      append(character);
    }
  }

  bool empty() const { return count_ == 0; }
  /// Something was typed that take() has not given, be it spoilt.
  bool waits() const { return count_ > 0 || spoiling_; }

  /// The first of them; not where it is empty.
  char take() {
    const char character = characters_[first_];
    first_ = (first_ + 1) % characters_.size();
    --count_;
    return character;
  }

  void clear() {
    count_ = 0;
    spoiling_ = false;
    line_begun_ = false;
  }

  /// Forgets what waits. One spoilt line takes its place: the one that is being typed, if any.
  void spoil() {
    count_ = 0;
    spoiling_ = line_begun_;
    if (!line_begun_) {
      append(spoilt);
      append('\n');
    }
  }

 private:
  void append(char character) {
    characters_[(first_ + count_) % characters_.size()] = character;
    ++count_;
  }

  std::array<char, 64> characters_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  bool spoiling_ = false;    ///< characters of the last line were left out
  bool line_begun_ = false;  ///< the last character ended no line
};

// The one word of a console that never waits.

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
