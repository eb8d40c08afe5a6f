/// Scenes that the tests of sweeps begin from.
#pragma once

#include <string>

#include "tests/common/scenes.hpp"

namespace sonoglide::sweep {

/// Means over the second half.
inline const std::string open_loop = table_1_open_loop + R"([run]
duration_periods = 40
window_start_periods = 20
)";

inline const std::string closed_loop = table_1_closed_loop + R"([run]
duration_periods = 60
[controller]
arithmetic = "float64"
target_friction_ratio = [[0.0, 0.4]]
)";

}  // namespace sonoglide::sweep
