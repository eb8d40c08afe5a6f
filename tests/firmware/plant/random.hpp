/// Random numbers for the plant's property tests.
#pragma once

#include <rapidcheck.h>

namespace sonoglide::plant {

/// One of a million steps; shrinks towards low.
inline double between(double low, double high) {
  return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1000001);
}

}  // namespace sonoglide::plant
