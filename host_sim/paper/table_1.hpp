/// The paper's Tables 1 and 2 as a scene, and its variations. Table 2 adds the solver, which is the
/// program's own here.
#pragma once

#include <string_view>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::paper {

/// 384 N, velocity ratio 0.5, from rest, 100 carrier periods: the file table_1.toml of the output.
extern const std::string_view table_1_text;

scene::Scene table_1();

/// The scene with the sliding velocity that belongs to a velocity ratio.
scene::Scene at_velocity_ratio(scene::Scene scene, double velocity_ratio);

/// Of the vibration without a contact.
double peak_vibration_m_per_s(const scene::Scene& scene);

/// The scene for one carrier period on its steady orbit.
scene::Scene steady(scene::Scene scene);

double period_s(const scene::Scene& scene);

/// Kt X/Fc with the amplitude X of the vibration without a contact.
double dahl_number(const scene::Scene& scene);

}  // namespace sonoglide::paper
