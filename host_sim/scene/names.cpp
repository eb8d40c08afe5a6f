#include "host_sim/scene/names.hpp"

#include <array>
#include <utility>

namespace sonoglide::scene {

std::string unit_of(std::string_view name) {
  // Of two that fit, the longer one.
  constexpr std::array<std::pair<std::string_view, const char*>, 17> units = {{
      {"_N_s_per_m", "N s/m"},
      {"_N_per_m", "N/m"},
      {"_N_per_V", "N/V"},
      {"_N_per_s", "N/s"},
      {"_m_per_s", "m/s"},
      {"_s_per_m", "s/m"},
      {"_per_m", "1/m"},
      {"_ohm", "ohm"},
      {"_kg", "kg"},
      {"_Hz", "Hz"},
      {"_H", "H"},
      {"_N", "N"},
      {"_V", "V"},
      {"_A", "A"},
      {"_F", "F"},
      {"_m", "m"},
      {"_s", "s"},
  }};
  for (const auto& [ending, unit] : units) {
    if (name.size() >= ending.size() && name.substr(name.size() - ending.size()) == ending) {
      return unit;
    }
  }
  return {};
}

}  // namespace sonoglide::scene
