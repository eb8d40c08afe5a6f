/// Scenes with tolerances.
#pragma once

#include <string>

#include "tests/common/scenes.hpp"

namespace sonoglide::robust {

inline const std::string target_step = table_1_closed_loop + R"([solver]
tolerance = 1e-8
[run]
duration_s = 1e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4]]
)";

inline const std::string uncertain_step = target_step + R"([tolerance]
"plant.stiffness_N_per_m" = 0.04
"friction.coefficient" = { normal = 0.02 }
"friction.contact_stiffness_N_per_m" = { range = [0.05e6, 0.06e6] }
)";

}  // namespace sonoglide::robust
