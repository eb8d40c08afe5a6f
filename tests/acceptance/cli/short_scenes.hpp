/// Scenes that are over at once, for tests of what surrounds a run.
#pragma once

#include <string>

#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance {

/// A table follows, or keys of `[run]`.
inline const std::string short_open_loop = table_1_open_loop + R"([run]
duration_periods = 4
)";

inline const std::string short_closed_loop = table_1_closed_loop + R"([run]
duration_periods = 60
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4]]
)";

}  // namespace sonoglide::acceptance
