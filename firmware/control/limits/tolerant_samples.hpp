/// A stated number of unusable samples is bridged.
#pragma once

#include <cstdint>

namespace sonoglide::control {

/// Every sample must be usable.
struct StrictSamples {
  struct Parameters {};

  explicit StrictSamples(const Parameters&) {}
  static constexpr void restart() {}
  /// @return whether the controller may go on
  static constexpr bool accept(bool usable) { return usable; }
};

/// N of the last M samples may be unusable. Until the next usable sample the last request stays in
/// force. With N = 0 it is as strict as StrictSamples.
class TolerantSamples {
 public:
  struct Parameters {
    std::uint8_t tolerated = 0;  ///< N, < window
    std::uint8_t window = 1;     ///< M, 1 … 32

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("tolerated", self.tolerated);
      visit("window", self.window);
    }
  };

  explicit TolerantSamples(const Parameters& parameters) : parameters_(parameters) {}

  void restart() { unusable_ = 0; }

  /// One call for each sample.
  /// @return whether the controller may go on
  bool accept(bool usable) {
    unusable_ = (unusable_ << 1 | (usable ? 0U : 1U)) & (UINT32_MAX >> (32 - parameters_.window));
    return usable || count(unusable_) <= parameters_.tolerated;
  }

 private:
  static std::uint32_t count(std::uint32_t bits) {
    std::uint32_t number = 0;
    for (; bits != 0; bits &= bits - 1) {
      ++number;
    }
    return number;
  }

  Parameters parameters_;
  std::uint32_t unusable_ = 0;  ///< a bit a sample, the latest lowest
};

}  // namespace sonoglide::control
