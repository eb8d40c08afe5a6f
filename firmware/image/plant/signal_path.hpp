/// What lies between the plant of an image and its controller: an ideal converter and a late drive.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sonoglide::image {

/// Whether a converter of 32 bits that gives this code stands at either end of its range.
constexpr bool at_rail(std::int32_t code) {
  return code == INT32_MAX || code == INT32_MIN;
}

/// A drive whose commands act some carrier periods late.
///
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

}  // namespace sonoglide::image
