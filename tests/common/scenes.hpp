/// Scenes of the paper's Table 1 to begin from: tables that a test adds to.
#pragma once

#include <string>

namespace sonoglide {

inline const std::string table_1_plant = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "dahl"
coefficient = 0.1
contact_stiffness_N_per_m = 0.056e6
[sliding]
velocity_m_per_s = 0.0267
)";

/// The same with dry friction.
inline const std::string coulomb_plant = R"([plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
[friction]
law = "coulomb"
coefficient = 0.1
[sliding]
velocity_m_per_s = 0.0267
)";

/// Without [run].
inline const std::string table_1_open_loop = table_1_plant + R"([drive]
frequency_Hz = 60e3
force_amplitude_N = 384.0
)";

/// Without [run] and [controller].
inline const std::string table_1_closed_loop = table_1_plant + R"([drive]
frequency_Hz = 60e3
max_force_amplitude_N = 1920.0
)";

}  // namespace sonoglide
