/// A closed loop that visits every part of the controller, the same in every arithmetic.
#pragma once

#include <cstdint>

#include "closed_loop.hpp"

namespace sonoglide::control {

/// Numbers in [0, 1) from a seed; Numerical Recipes' constants, the top bits.
class Sequence {
 public:
  explicit Sequence(std::uint32_t seed) : state_(seed) {}
  double next() {
    state_ = 1664525U * state_ + 1013904223U;
    return static_cast<double>(state_ >> 8) * 0x1p-24;
  }

 private:
  std::uint32_t state_;
};

/// Target steps, a speed that wanders and reverses, sensor noise; nothing near a range's end.
/// Calls visit(i, loop) after each of `periods` periods.
template <class PartsT, class Visit>
void scripted_run(std::uint32_t seed, int periods, Visit visit) {
  Sequence sequence(seed);
  ClosedLoop<PartsT> loop({});
  double velocity = 0.1;
  double slope = 0.0;
  for (int i = 0; i < periods; ++i) {
    if (i % 100 == 0) {
      loop.set_target(0.4 + 0.5 * sequence.next());
      slope = (0.15 * (sequence.next() - 0.5) - velocity) / 100.0;
    }
    velocity += slope;
    loop.step(velocity, 0.02 * (sequence.next() - 0.5));
    visit(i, loop);
  }
}

}  // namespace sonoglide::control
