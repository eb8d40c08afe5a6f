#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "host_sim/scene/bound.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/table_cursor.hpp"
#include "host_sim/scene_file/table_reader.hpp"

namespace sonoglide::scene_file {
namespace {

/// The numbers that a scene has, by `table.key`.
class ScenesNumbers {
 public:
  explicit ScenesNumbers(const scene::Scene& scene) : echo_(to_json(scene)) {}

  bool has(std::string_view path) const { return value_of(path) != nullptr; }

  std::optional<double> find(std::string_view path) const {
    const nlohmann::ordered_json* value = value_of(path);
    return value != nullptr && value->is_number() ? std::optional(value->get<double>())
                                                  : std::nullopt;
  }

 private:
  const nlohmann::ordered_json* value_of(std::string_view path) const {
    const std::size_t dot = path.find('.');
    const auto table = echo_.find(path.substr(0, dot));
    if (table == echo_.end()) {
      return nullptr;
    }
    const auto value = table->find(path.substr(dot + 1));
    return value != table->end() ? &*value : nullptr;
  }

  nlohmann::ordered_json echo_;
};

struct ProfiledKey {
  std::string_view number;
  std::string_view profile;
};
constexpr std::array<ProfiledKey, 3> profiled_keys = {
    {{"plant.stiffness_N_per_m", "plant.stiffness_profile"},
     {"friction.coefficient", "friction.coefficient_profile"},
     {"friction.normal_force_N", "friction.normal_force_profile_N"}}};

/// Why a key has no number that a plant could have otherwise.
std::string no_value(const ScenesNumbers& numbers, std::string_view key) {
  for (const ProfiledKey& each : profiled_keys) {
    if (each.number == key && numbers.has(each.profile)) {
      return fmt::format("here: the scene has {} in its place, which stays as it is", each.profile);
    }
  }
  return "here: the scene has no value of it";
}

const Spread& allowed_spread(const TableCursor& cursor, std::string_view key) {
  return std::get<Spread>(key_of(cursor.keys(), key).allowed);
}

/// Largest relative half width that stays in the range, rounded down.
double widest(const Range& range, double value) {
  constexpr double steps = 1e6;
  return std::floor(steps * std::min(value - range.low, range.high - value) / std::abs(value)) /
         steps;
}

/// Fills in what follows from the scene's value.
void settle(const TableCursor& cursor, scene::Tolerance& tolerance) {
  if (tolerance.spread == scene::Spread::range) {
    return;
  }
  if (tolerance.nominal == 0.0) {
    cursor.fail(
        tolerance.key,
        fmt::format("is relative to {}, which is 0; allowed: {{ range = [lowest, highest] }}",
                    tolerance.key));
  }
  if (tolerance.spread == scene::Spread::normal) {
    return;
  }
  const Range& range = allowed_spread(cursor, tolerance.key).range;
  const double half_width = tolerance.amount * std::abs(tolerance.nominal);
  tolerance.lowest = tolerance.nominal - half_width;
  tolerance.highest = tolerance.nominal + half_width;
  if (!range.contains(tolerance.lowest) || !range.contains(tolerance.highest)) {
    cursor.fail(tolerance.key,
                fmt::format("{} leaves the range of {}, {}; allowed: {} {}", tolerance.amount,
                            tolerance.key, range.text(), range.low_open ? "below" : "at most",
                            scene::at_most(widest(range, tolerance.nominal))));
  }
}

}  // namespace

std::vector<scene::Tolerance> read_tolerances(const Variant& variant, const scene::Scene& so_far) {
  const TableCursor cursor(variant, "tolerance");
  std::vector<scene::Tolerance> tolerances;
  if (!cursor.present()) {
    return tolerances;
  }
  const TableCursor true_values(variant, "true_values");
  const ScenesNumbers numbers(so_far);
  for (const std::string& key : cursor.given_keys()) {
    scene::Tolerance tolerance = cursor.spread(key, allowed_spread(cursor, key));
    const std::optional<double> nominal = numbers.find(key);
    if (!nominal) {
      cursor.reject(key, no_value(numbers, key));
      continue;
    }
    if (true_values.has(key)) {
      cursor.fail(key, fmt::format("excludes true_values.{}; allowed: one of the two", key));
    }
    tolerance.nominal = *nominal;
    settle(cursor, tolerance);
    tolerances.push_back(std::move(tolerance));
  }
  return tolerances;
}

namespace {

constexpr std::string_view true_values_table = "true_values";

}  // namespace

std::vector<scene::TrueValue> given_true_values(const Variant& variant) {
  const TableCursor cursor(variant, true_values_table);
  std::vector<scene::TrueValue> values;
  for (const std::string& key : cursor.given_keys()) {
    const Allowed& allowed = key_of(cursor.keys(), key).allowed;
    const auto* whole = std::get_if<Integer>(&allowed);
    values.push_back({key,
                      whole != nullptr ? static_cast<double>(cursor.integer(key, *whole))
                                       : cursor.real(key, std::get<Number>(allowed).range),
                      whole != nullptr});
  }
  return values;
}

std::vector<scene::TrueValue> read_true_values(const Variant& variant, const scene::Scene& so_far) {
  const TableCursor cursor(variant, true_values_table);
  if (!cursor.present()) {
    return {};
  }
  std::vector<scene::TrueValue> values = given_true_values(variant);
  const ScenesNumbers numbers(so_far);
  const auto has_none = [&](const scene::TrueValue& each) {
    const bool none = !numbers.find(each.key);
    if (none) {
      cursor.reject(each.key, no_value(numbers, each.key));
    }
    return none;
  };
  values.erase(std::remove_if(values.begin(), values.end(), has_none), values.end());
  return values;
}

}  // namespace sonoglide::scene_file
