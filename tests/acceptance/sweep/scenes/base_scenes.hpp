/// Scenes that sweeps are run on.
#pragma once

namespace sonoglide::acceptance {

constexpr const char* open_loop_scene = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "dahl"
coefficient = 0.1
contact_stiffness_N_per_m = 0.056e6
[sliding]
velocity_m_per_s = 0.0267
[drive]
frequency_Hz = 60e3
force_amplitude_N = 384.0
[run]
duration_periods = 20
window_start_periods = 10
)";

constexpr const char* closed_loop_scene = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "dahl"
coefficient = 0.1
contact_stiffness_N_per_m = 0.056e6
[sliding]
velocity_m_per_s = 0.0267
[drive]
frequency_Hz = 60e3
max_force_amplitude_N = 1920.0
[run]
duration_periods = 60
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4]]
[sensor]
force_noise_N = 1e-4
)";

}  // namespace sonoglide::acceptance
