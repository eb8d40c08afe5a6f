/// The end of a drive whose host fell silent.
#pragma once

#include <atomic>
#include <cstdint>

namespace sonoglide::app {

/// The amplitude falls to zero along a straight line, over `periods` carrier periods, whatever the
/// readings are. Switching off at once would leave a ringing at a natural mode of angular frequency
/// w. A line of duration T leaves at most 2 / (w T) of it, and needs no model of the mode.
class HostRamp {
 public:
  /// The host asks for every start.
  static constexpr bool drives_from_power_on = false;
  /// A service may read what the control side writes.
  template <class T>
  using Word = std::atomic<T>;
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
