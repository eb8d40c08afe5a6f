#include "host_sim/scene_file/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene_file/range.hpp"
#include "host_sim/scene_file/suggestion.hpp"

namespace sonoglide::scene_file {
namespace {

/// The table that owns this key; null if none does.
const TableSchema* find_owner(std::string_view key) {
  for (const TableSchema& table : schema()) {
    if (std::find(table.keys.begin(), table.keys.end(), key) != table.keys.end()) {
      return &table;
    }
  }
  return nullptr;
}

std::vector<std::string_view> table_names() {
  std::vector<std::string_view> names;
  for (const TableSchema& table : schema()) {
    names.push_back(table.name);
  }
  return names;
}

/// Lists the keys that friction laws have of their own.
class KeyList {
 public:
  explicit KeyList(std::vector<std::string_view>& keys) : keys_(keys) {}

  void required(std::string_view key, double /*parameter*/, const Range& /*range*/) { add(key); }
  void optional(std::string_view key, double /*parameter*/, const Range& /*range*/) { add(key); }
  void optional(std::string_view key, int /*count*/, int /*least*/, int /*most*/) { add(key); }
  void refuse(std::string_view /*key*/, double /*parameter*/, std::string_view /*finding*/,
              double /*least*/, std::string_view /*rest*/) {}

 private:
  /// Laws may share a key.
  void add(std::string_view key) {
    if (std::find(keys_.begin(), keys_.end(), key) == keys_.end()) {
      keys_.push_back(key);
    }
  }

  std::vector<std::string_view>& keys_;
};

/// Those of all laws.
std::vector<std::string_view> friction_keys() {
  std::vector<std::string_view> keys = {"law",
                                        "coefficient",
                                        "coefficient_profile",
                                        "normal_force_N",
                                        "normal_force_profile_N",
                                        "contact_stiffness_N_per_m",
                                        "initial_force_N",
                                        "sign_convention"};
  KeyList own(keys);
  for (scene::FrictionLaw law : scene::every_law) {
    std::visit([&](auto& any) { any.visit_keys(own, scene::Contact{}); }, law);
  }
  return keys;
}

}  // namespace

const std::vector<TableSchema>& schema() {
  static const std::vector<TableSchema> tables = {
      {"plant",
       {"mass_kg", "stiffness_N_per_m", "damping_N_s_per_m", "initial_displacement_m",
        "initial_velocity_m_per_s"}},
      {"friction", friction_keys()},
      {"sliding", {"velocity_m_per_s", "profile"}},
      {"drive",
       {"frequency_Hz", "force_amplitude_N", "waveform", "max_force_amplitude_N",
        "max_force_slew_N_per_s", "delay_periods"}},
      {"solver", {"method", "tolerance", "order", "step_s"}},
      {"run",
       {"start", "duration_s", "duration_periods", "window_start_s", "window_start_periods",
        "settling_band", "record", "record_interval_s"}},
      {"controller",
       {"arithmetic", "target_friction_ratio", "calibration_s", "shaping", "speed_floor_m_per_s",
        "standstill_hold_s", "relearn_every_s", "mismatch_warning"}},
      {"sensor",
       {"adc_bits", "force_full_scale_N", "force_noise_N", "force_bandwidth_Hz", "delay_periods",
        "force_offset_N", "force_gain", "velocity_offset_m_per_s", "velocity_gain", "seed"}},
      {"model_error", {"mass", "stiffness", "coefficient", "contact_stiffness"}},
  };
  return tables;
}

const TableSchema* find_table(std::string_view name) {
  for (const TableSchema& table : schema()) {
    if (table.name == name) {
      return &table;
    }
  }
  return nullptr;
}

std::string unknown_table(std::string_view name) {
  if (const TableSchema* owner = find_owner(name)) {
    return fmt::format("unknown table; did you mean {}.{}?", owner->name, name);
  }
  const std::vector<std::string_view> names = table_names();
  if (const auto nearest = nearest_name(name, names)) {
    return fmt::format("unknown table; did you mean {}?", *nearest);
  }
  return fmt::format("unknown table; allowed: {}", fmt::join(names, ", "));
}

std::string unknown_key(const TableSchema& table, std::string_view key) {
  if (const auto nearest = nearest_name(key, table.keys)) {
    return fmt::format("unknown key; did you mean {}?", *nearest);
  }
  if (const TableSchema* owner = find_owner(key)) {
    return fmt::format("unknown key; did you mean {}.{}?", owner->name, key);
  }
  return fmt::format("unknown key; allowed: {}", fmt::join(table.keys, ", "));
}

}  // namespace sonoglide::scene_file
