/// The end of a drive whose host fell silent.
#pragma once

#include <cstdint>

namespace sonoglide::app {

/// The amplitude falls to zero along a straight line, over `periods` carrier periods, whatever the
/// readings say. Of the ringing at a natural mode of angular frequency w that switching off at once
/// would leave, the line leaves at most 2 / (w T) in a time of T, and asks for no model of the
/// mode.
class HostRamp {
 public:
  /// The host asks for a start.
  static constexpr bool drives_from_power_on = false;
  static constexpr std::int32_t periods = 128;

  /// @param amplitude  code in force, 0 … 2^31 − 1.
  void begin(std::int32_t amplitude) {
    step_ = amplitude / periods;
    left_ = periods;
  }
  void clear() { left_ = 0; }

  /// Begun and not yet at zero.
  bool falling() const { return left_ > 0; }

  /// Amplitude code of the next carrier period.
  std::int32_t next() { return step_ * --left_; }

 private:
  std::int32_t step_ = 0;
  std::int32_t left_ = 0;  ///< carrier periods until zero
};

}  // namespace sonoglide::app
