/// The latency of a drive: commands act some carrier periods late.
#pragma once

#include <array>
#include <cstddef>

namespace sonoglide::hal::simulated {

/// @tparam Periods  from the end of the period that a sample describes to the phase 0 at which its
///                  answer acts
template <class Amplitude, std::size_t Periods>
class DriveLatency {
 public:
  void take(Amplitude amplitude) {
    for (std::size_t i = 0; i < Periods; ++i) {
      queue_[i] = queue_[i + 1];
    }
    queue_[Periods] = amplitude;
  }

  /// In force in the next carrier period.
  Amplitude in_force() const { return queue_[0]; }

 private:
  std::array<Amplitude, Periods + 1> queue_{};
};

}  // namespace sonoglide::hal::simulated
