/// What a timed loop of the tests drives: a board whose carrier periods are counted by hand.
#pragma once

#include <cstdint>

#include "hal/host/simulated_board.hpp"

namespace sonoglide::app::scene_units_test {

template <class Sample, class Drive>
class PeriodBoard : public hal::host::SimulatedBoard<Sample, Drive> {
 public:
  void begin_period() { ++period_; }
  std::uint32_t period() const { return period_; }

 private:
  std::uint32_t period_ = 0;
};

struct NeverReset {
  static void feed() {}
  static bool caused_reset() { return false; }
};

}  // namespace sonoglide::app::scene_units_test
