/// The unit in a name.
#pragma once

#include <string>
#include <string_view>

namespace sonoglide::scene {

/// The unit that a name ends with, as `m/s` of `sliding_velocity_m_per_s` and of `_m_per_s`; empty of a pure
/// number.
std::string unit_of(std::string_view name);

}  // namespace sonoglide::scene
