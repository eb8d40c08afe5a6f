/// Ranges that several keys of a scene have.
#pragma once

#include "host_sim/scene_file/key.hpp"

namespace sonoglide::scene_file {

inline constexpr double largest_force_N = 1e12;
inline constexpr double largest_speed_m_per_s = 1e6;
inline constexpr Range time_range{0.0, 1e9, "s"};
inline constexpr Range speed_range{-largest_speed_m_per_s, largest_speed_m_per_s, "m/s"};
inline constexpr Range force_range{0.0, largest_force_N, "N"};
inline constexpr Range frequency_range{1e-3, 1e9, "Hz"};

}  // namespace sonoglide::scene_file
