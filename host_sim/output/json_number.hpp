/// How the JSON files write a number.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace sonoglide::output {

/// A figure; null where it is not finite.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// A figure; null where there is none.
inline nlohmann::ordered_json json_number(const std::optional<double>& value) {
  return value ? json_number(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace sonoglide::output
