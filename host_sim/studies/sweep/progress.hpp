/// How far a sweep is.
#pragma once

#include <functional>

namespace sonoglide::sweep {

/// Called now and then with the part of the time that is gone, in [0, 1], by one thread at a time:
/// time gone × (1 − fraction) / fraction is the time left. It falls where the rest turns out to
/// take longer than it seemed.
using Progress = std::function<void(double fraction)>;

}  // namespace sonoglide::sweep
