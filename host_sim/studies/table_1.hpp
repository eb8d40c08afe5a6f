/// Table 1 of the paper at 384 N and a velocity ratio of 0.5, as the tables of a scene.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace sonoglide::table_1 {

inline constexpr std::string_view plant = "[plant]\nmass_kg = 0.02\nstiffness_N_per_m = 133e6\n";

/// Of [friction]; the normal force is the weight.
inline constexpr std::string_view contact_stiffness = "contact_stiffness_N_per_m = 0.056e6\n";

/// Keys of [friction] under a law.
/// @param beside  the coefficient
inline std::string contact(std::string_view law, std::string_view beside) {
  return fmt::format("law = \"{}\"\ncoefficient = 0.1\n{}", law, beside);
}
inline std::string contact() {
  return contact("dahl", contact_stiffness);
}

inline constexpr double velocity_ratio = 0.5;
inline constexpr std::string_view motion =
    "[sliding]\nvelocity_m_per_s = 0.026714794439561918\n\n"
    "[drive]\nfrequency_Hz = 60e3\nforce_amplitude_N = 384.0\n";

}  // namespace sonoglide::table_1
