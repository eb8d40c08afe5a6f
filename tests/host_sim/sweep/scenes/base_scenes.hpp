/// Scenes that the tests of sweeps begin from.
#pragma once

#include <string>

namespace sonoglide::sweep {

inline const std::string plant_and_contact = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "dahl"
coefficient = 0.1
contact_stiffness_N_per_m = 0.056e6
[sliding]
velocity_m_per_s = 0.0267
)";

/// Table 1 at 384 N, from rest; means over the second half.
inline const std::string open_loop = plant_and_contact + R"([drive]
frequency_Hz = 60e3
force_amplitude_N = 384.0
[run]
duration_periods = 40
window_start_periods = 20
)";

inline const std::string closed_loop = plant_and_contact + R"([drive]
frequency_Hz = 60e3
max_force_amplitude_N = 1920.0
[run]
duration_periods = 60
[controller]
arithmetic = "float64"
target_friction_ratio = [[0.0, 0.4]]
)";

}  // namespace sonoglide::sweep
