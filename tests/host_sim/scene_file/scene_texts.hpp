/// Scenes that use every key a scene can have.
#pragma once

#include <string>

#include "tests/common/scenes.hpp"

namespace sonoglide::scene_file {

/// Every key of a loop that holds the vibration at resonance.
inline constexpr const char* resonant_closed_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 2842446067.7
damping_N_s_per_m = 37.7
[friction]
law = "coulomb"
coefficient = 0.1
[sliding]
velocity_m_per_s = 0.0267
[transducer]
force_factor_N_per_V = 1
clamped_capacitance_F = 2e-9
[drive]
frequency_Hz = 60e3
frequency_resolution_Hz = 2.5
max_voltage_amplitude_V = 12
max_current_amplitude_A = 0.3
[run]
duration_s = 2e-3
[controller]
arithmetic = "q31"
vibration = "resonant"
frequency_range_Hz = [58e3, 62e3]
target_friction_ratio = [[0, 0.5]]
[sensor]
force = true
vibration = "motional_current"
vibration_bits = 12
vibration_noise_m_per_s = 1e-4
vibration_full_scale_m_per_s = 0.25
[model_error]
force_factor = 1.1
damping = 0.9
)";

/// A loop that damps the natural mode under a drive that is a force.
inline constexpr const char* damped_closed_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 2.5e6
[friction]
law = "coulomb"
coefficient = 0.1
[sliding]
velocity_m_per_s = 0.0267
[drive]
frequency_Hz = 60e3
max_force_amplitude_N = 1920
bias_limit_N = 5
[run]
duration_s = 2e-3
[controller]
arithmetic = "q31"
vibration = "damped"
target_friction_ratio = [[0, 0.5]]
[sensor]
force = false
vibration = "velocity"
vibration_bits = 14
[model_error]
damping = 0.9
)";

/// A body of its own mass that slides.
inline constexpr const char* load_open_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "dahl"
coefficient = 0.1
contact_stiffness_N_per_m = 0.056e6
[load]
mass_kg = 0.5
damping_N_s_per_m = 0.2
initial_velocity_m_per_s = 0.01
force_profile_N = [[0, 0.1], [1e-3, 0.1], [1e-3, -0.1]]
spring_N_per_m = 2e3
pull_profile_m_per_s = [[0, 0.02], [1e-3, 0.0]]
[drive]
frequency_Hz = 60e3
force_amplitude_N = 384
[run]
duration_s = 2e-3
record = ["sliding_velocity_m_per_s", "load_displacement_m"]
record_interval_s = 1e-5
)";

/// Nothing that has a default.
inline const std::string shortest_open_loop = table_1_plant + R"([run]
duration_s = 2e-3
)";

inline constexpr const char* fullest_open_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
damping_N_s_per_m = 1.5
initial_displacement_m = -1e-7
initial_velocity_m_per_s = 2e-3
[friction]
law = "dahl"
coefficient = 0.2
normal_force_N = 3
contact_stiffness_N_per_m = 0.056e6
initial_force_N = -0.25
sign_convention = "as_printed"
[sliding]
profile = [[1e-3, 0.02], [2e-3, -0.02]]
[drive]
frequency_Hz = 40e3
force_amplitude_N = 384
waveform = "cosine"
[solver]
method = "rk4"
step_s = 1e-8
[run]
duration_periods = 100
window_start_periods = 50
record = ["sliding_velocity_m_per_s", "displacement_m", "velocity_m_per_s", "friction_force_N",
          "drive_force_N"]
record_interval_s = 1e-6
)";

/// A Stribeck curve.
inline constexpr const char* curve_open_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 8e3
[friction]
law = "stribeck"
coefficient = 0.2
fall_s_per_m = 1.5
rise_s3_per_m3 = 50
[sliding]
velocity_m_per_s = 0.01
[run]
duration_s = 1e-2
)";

/// A contact of bristles under a wave of straight pieces.
inline constexpr const char* bristles_open_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "lugre"
coefficient = 0.2
contact_stiffness_N_per_m = 0.056e6
static_coefficient = 0.3
stribeck_velocity_m_per_s = 0.01
bristle_damping_N_s_per_m = 0.02
viscous_friction_N_s_per_m = 0.03
[sliding]
velocity_m_per_s = 0.0267
[drive]
frequency_Hz = 40e3
force_amplitude_N = 384
waveform = "triangle"
[run]
duration_periods = 100
)";

/// Springs in parallel that slip.
inline constexpr const char* springs_open_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "iwan"
coefficient = 0.2
contact_stiffness_N_per_m = 0.056e6
elements = 8
[sliding]
velocity_m_per_s = 0.0267
[run]
duration_s = 1e-3
)";

/// Vibration normal to the surface.
inline constexpr const char* normal_open_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "normal_coulomb"
coefficient = 0.5
contact_stiffness_N_per_m = 0.6e6
normal_contact_stiffness_N_per_m = 0.7e6
[sliding]
velocity_m_per_s = 0.0203
[run]
duration_s = 1e-3
)";

/// Friction that changes in time.
inline constexpr const char* profiles_open_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "dahl"
coefficient_profile = [[0, 0.1], [1e-3, 0.1], [1e-3, 0.2], [2e-3, 0]]
normal_force_profile_N = [[5e-4, 0.2]]
contact_stiffness_N_per_m = 0.056e6
[sliding]
velocity_m_per_s = 0.0267
[run]
duration_s = 2e-3
)";

inline constexpr const char* transducer_open_loop = R"([plant]
mass_kg = 0.02
stiffness_profile = [[0, 133e6], [1e-3, 134e6], [1e-3, 132e6]]
[friction]
law = "dahl"
coefficient = 0.1
contact_stiffness_N_per_m = 0.056e6
[sliding]
velocity_m_per_s = 0.0267
[transducer]
force_factor_N_per_V = 16
clamped_capacitance_F = 2e-6
loss_tangent = 0.004
[drive]
frequency_Hz = 60e3
frequency_profile = [[0, 60e3], [1e-3, 61e3]]
frequency_resolution_Hz = 2.5
voltage_amplitude_V = 10
[run]
duration_s = 2e-3
)";

inline const std::string transducer_closed_loop = coulomb_plant + R"([transducer]
force_factor_N_per_V = 16
clamped_capacitance_F = 2e-6
[drive]
frequency_Hz = 60e3
max_voltage_amplitude_V = 120
[run]
duration_s = 2e-3
[controller]
arithmetic = "q31"
target_friction_force_N = [[0, 0.01]]
[sensor]
samples_per_period = 8
filter_Hz = 60e3
)";

inline const std::string textured_closed_loop = table_1_closed_loop + R"([run]
duration_s = 2e-3
[controller]
arithmetic = "q31"
target_texture = { period_m = 1e-4, ratio = [0.4, 0.6, 0.5] }
)";

/// Nothing that has a default.
inline const std::string shortest_closed_loop = coulomb_plant + R"([drive]
frequency_Hz = 60e3
max_force_amplitude_N = 1920
[run]
duration_s = 2e-3
[controller]
arithmetic = "q31"
target_friction_ratio = [[0, 1]]
)";

inline constexpr const char* fullest_closed_loop = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "dahl"
coefficient = 0.1
normal_force_N = 0.1962
contact_stiffness_N_per_m = 0.056e6
[sliding]
velocity_m_per_s = -0.0267
[drive]
frequency_Hz = 60e3
max_force_amplitude_N = 1920
max_force_slew_N_per_s = 1e8
bits = 12
interpolation = "linear"
codes_per_period = 4
[solver]
method = "event_taylor"
tolerance = 1e-12
order = 16
[run]
duration_s = 4e-3
window_start_s = 1e-3
settling_band = 0.02
[controller]
arithmetic = "float32"
every_periods = 2
target_friction_ratio = [[0.0, 0.4], [2e-3, 0.6]]
friction = "calibrated"
calibration_s = 0.5e-3
relearn_every_s = 0.1
shaping = "robust"
shaping_range = 0.2
speed_floor_m_per_s = 1e-4
[sensor]
adc_bits = 12
force_full_scale_N = 0.04
force_noise_N = 1e-4
force_bandwidth_Hz = 5e3
delay_periods = 2
force_offset_N = -2e-3
force_gain = 0.9
velocity_offset_m_per_s = 1e-3
velocity_gain = -1
velocity_bits = 14
seed = 9223372036854775807
[model_error]
mass = 0.9
stiffness = 1.04
coefficient = 1.3
contact_stiffness = 1.5
)";

}  // namespace sonoglide::scene_file
