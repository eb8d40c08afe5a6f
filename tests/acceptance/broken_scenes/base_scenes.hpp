/// Six good scenes, from which the broken ones differ by one edit.
#pragma once

#include <string>

#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance {

inline const std::string open_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "dahl"
coefficient = 0.1
normal_force_N = 0.1962
contact_stiffness_N_per_m = 0.056e6
[sliding]
velocity_m_per_s = 0.0267
[drive]
frequency_Hz = 60e3
force_amplitude_N = 384.0
[solver]
method = "event_taylor"
tolerance = 1e-10
[run]
duration_periods = 20
record = ["displacement_m"]
record_interval_s = 1e-6
)";

inline const std::string moving_open_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "coulomb"
coefficient = 0.1
normal_force_profile_N = [[0, 0.2], [1e-4, 0.2], [1e-4, 0.3]]
[sliding]
velocity_m_per_s = 0.0267
[drive]
frequency_Hz = 60e3
force_amplitude_N = 384.0
[run]
duration_periods = 20
)";

inline const std::string control_of_1_ms = R"([run]
duration_s = 1e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]
[sensor]
adc_bits = 12
[model_error]
stiffness = 1.04
)";

inline const std::string closed_loop = table_1_closed_loop + control_of_1_ms;

inline const std::string tracked_loop = table_1_closed_loop + R"([run]
duration_s = 1e-3
[controller]
arithmetic = "float32"
friction = "tracked"
target_friction_ratio = [[0.0, 0.4]]
)";

inline const std::string resonant_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 2842446067.7
damping_N_s_per_m = 37.7
[friction]
law = "dahl"
coefficient = 0.1
contact_stiffness_N_per_m = 0.056e6
[sliding]
velocity_m_per_s = 0.0267
[transducer]
force_factor_N_per_V = 1.0
clamped_capacitance_F = 2e-9
[drive]
frequency_Hz = 60e3
max_voltage_amplitude_V = 8
[run]
duration_s = 2e-3
[controller]
arithmetic = "float32"
vibration = "resonant"
target_friction_ratio = [[0.0, 0.5]]
[sensor]
vibration = "velocity"
)";

inline const std::string damped_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
damping_N_s_per_m = 1
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
duration_s = 2e-3
[controller]
arithmetic = "float32"
vibration = "damped"
target_friction_ratio = [[0.0, 0.5]]
[sensor]
vibration = "velocity"
)";

inline const std::string coulomb_closed_loop = coulomb_plant + R"([drive]
frequency_Hz = 60e3
max_force_amplitude_N = 1920.0
)" + control_of_1_ms;

}  // namespace sonoglide::acceptance
