/// A clock that nobody sets.
#pragma once

#include <chrono>

namespace sonoglide::sweep {

/// Time in s since some beginning.
inline double steady_time_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace sonoglide::sweep
