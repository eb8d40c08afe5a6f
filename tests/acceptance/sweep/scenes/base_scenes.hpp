/// Scenes that sweeps are run on.
#pragma once

#include <string>

#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance {

inline const std::string open_loop_scene = table_1_open_loop + R"([run]
duration_periods = 20
window_start_periods = 10
)";

inline const std::string closed_loop_scene = table_1_closed_loop + R"([run]
duration_periods = 60
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4]]
[sensor]
force_noise_N = 1e-4
)";

}  // namespace sonoglide::acceptance
