/// A design as data.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "host_sim/studies/design/study.hpp"

namespace sonoglide::design {

/// One line for each ratio and speed, 17 digits.
std::string requirements_csv(const Study& study);

/// One line for each ratio and tuning Ks/(m w²), at the fastest of the task's speeds, 17 digits.
std::string detuning_csv(const Study& study);

/// The design points with their sensitivities, the reach of each ratio, and the tuning bands.
nlohmann::ordered_json to_json(const Study& study);

}  // namespace sonoglide::design
