/// Detects frames that come twice, late, or not at all.
#pragma once

#include <cstdint>

namespace sonoglide::link {

enum class Turn : std::uint8_t {
  next,      ///< the one after the last
  skipped,   ///< newer than the next: frames between them were lost, or come late
  repeated,  ///< the last one again
  late,      ///< older than the last
};

/// Follows the sequence numbers of one sender, which count up by one and wrap. The first number is
/// in turn, whatever it is. Of two numbers the newer is the one less than half the range ahead.
class SequenceWatch {
 public:
  /// Judges a frame; `next` and `skipped` become the last.
  Turn take(std::uint16_t sequence) {
    const auto ahead = static_cast<std::uint16_t>(sequence - last_);
    if (!begun_ || (ahead != 0 && ahead < 0x8000U)) {
      const bool in_turn = !begun_ || ahead == 1;
      begun_ = true;
      last_ = sequence;
      return in_turn ? Turn::next : Turn::skipped;
    }
    return ahead == 0 ? Turn::repeated : Turn::late;
  }

  /// Another sender, whose first number is in turn.
  void restart() { begun_ = false; }

  std::uint16_t last() const { return last_; }

 private:
  std::uint16_t last_ = 0;
  bool begun_ = false;
};

}  // namespace sonoglide::link
