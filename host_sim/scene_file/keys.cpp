#include "host_sim/scene_file/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <stdexcept>
#include <utility>

#include "host_sim/scene/bound.hpp"
#include "host_sim/scene_file/uses.hpp"

namespace sonoglide::scene_file {

std::string Range::text() const {
  const std::string bounds =
      fmt::format(fmt::runtime(low_open ? "above {}, at most {}" : "{} to {}"),
                  scene::at_least(low), scene::at_most(high));
  return unit.empty() ? bounds : fmt::format("{} {}", bounds, unit);
}

std::string Key::used_text() const {
  std::string text;
  for (const Use& use : uses) {
    const bool goes_on = use.text.rfind("with", 0) == 0;
    text += (text.empty() || use.text.empty() ? "" : goes_on ? " " : "; ") + use.text;
  }
  return text;
}

namespace {

std::string_view unit_in(const Allowed& allowed) {
  if (const auto* number = std::get_if<Number>(&allowed)) {
    return number->range.unit;
  }
  if (const auto* integer = std::get_if<Integer>(&allowed)) {
    return integer->unit;
  }
  if (const auto* interval = std::get_if<Interval>(&allowed)) {
    return interval->range.unit;
  }
  if (const auto* spread = std::get_if<Spread>(&allowed)) {
    return spread->range.unit;
  }
  const auto* profile = std::get_if<Profile>(&allowed);
  return profile != nullptr ? profile->value.unit : "";
}

template <auto Table>
void add(scene::Scene& scene) {
  (scene.*Table).emplace();
}
template <auto Table>
bool has(const scene::Scene& scene) {
  return (scene.*Table).has_value();
}

std::vector<KeyTable> plain_tables() {
  using scene::Scene;
  return {
      {"plant", true, "the mass that vibrates, on a spring and a damper", plant_keys()},
      {"friction", true, "the contact and its friction law", friction_keys()},
      {"sliding", true, "how the body slides over the contact; or a table [load]", sliding_keys(),
       uses::no_load, nullptr, [](const Scene& scene) { return !scene.load; }},
      {"load", false,
       "a body of its own mass that slides, in place of [sliding]: M dVt/dt = Fa - c Vt - k (x - ∫v_pull dt) - F, F "
       "the friction, which acts on the vibrating mass in the opposite direction",
       load_keys(), uses::always, add<&Scene::load>, has<&Scene::load>},
      {"transducer", false,
       "the piezo transducer between amplifier and mass; without this table the drive is a force",
       transducer_keys(), uses::a_drive, add<&Scene::transducer>, has<&Scene::transducer>},
      {"drive", false, "the force that drives the vibration; needed in closed loop", drive_keys(),
       uses::always, add<&Scene::drive>, has<&Scene::drive>},
      {"solver", false, "how the motion is computed", solver_keys()},
      {"run", true, "how long to simulate and what to record", run_keys()},
      {"controller", false,
       "the controller of the friction ratio; a scene with this table runs in closed loop, without "
       "it in open loop",
       controller_keys(), uses::always, add<&Scene::controller>, has<&Scene::controller>},
      {"sensor", false, "errors of the sensors, in closed loop; ideal without this table",
       sensor_keys(), uses::closed_loop},
      {"model_error", false,
       "nominal over true value of the parameters that the controller is designed with, in closed "
       "loop; 1 without this table",
       model_error_keys(), uses::closed_loop},
  };
}

/// Of these the controller alone knows: the plant has no other value of them.
constexpr std::array settings = {"drive.frequency_resolution_Hz",
                                 "drive.codes_per_period",
                                 "drive.bias_limit_N",
                                 "drive.max_current_amplitude_A",
                                 "drive.max_force_slew_N_per_s",
                                 "sensor.force_full_scale_N",
                                 "sensor.vibration_full_scale_m_per_s"};

/// An integer that a double holds.
constexpr std::int64_t largest_integer = std::int64_t{1} << 53;

Allowed varied_range(const Allowed& allowed) {
  const auto* integer = std::get_if<Integer>(&allowed);
  return integer == nullptr
             ? allowed
             : Integer{integer->low, std::min(integer->high, largest_integer), integer->unit};
}

/// A number that a plant may have otherwise than its scene says.
struct Variable {
  std::string_view name;  ///< `table.key`; lives for good
  Allowed allowed;        ///< Number or Integer
  Uses uses;
};

std::vector<Variable> variables(const std::vector<KeyTable>& tables) {
  static std::deque<std::string> names;
  std::vector<Variable> all;
  for (const KeyTable& table : tables) {
    constexpr std::array varied = {"plant", "friction", "load", "transducer", "drive", "sensor"};
    if (std::find(varied.begin(), varied.end(), table.name) == varied.end()) {
      continue;
    }
    for (const Key& key : table.keys) {
      const bool numeric = std::holds_alternative<Number>(key.allowed) ||
                           std::holds_alternative<Integer>(key.allowed);
      std::string name = fmt::format("{}.{}", table.name, key.name);
      if (numeric && std::find(settings.begin(), settings.end(), name) == settings.end()) {
        names.push_back(std::move(name));
        all.push_back({names.back(), varied_range(key.allowed), key.uses});
      }
    }
  }
  return all;
}

Spread spread_of(const Allowed& allowed) {
  if (const auto* number = std::get_if<Number>(&allowed)) {
    return {number->range};
  }
  const auto& integer = std::get<Integer>(allowed);
  return {{static_cast<double>(integer.low), static_cast<double>(integer.high), integer.unit},
          true};
}

void add_tables_of_others(std::vector<KeyTable>& tables) {
  KeyTable tolerance{"tolerance",
                     false,
                     "by how much the plant may differ from the scene, for which the controller is "
                     "designed; used by robust, ignored by the other commands",
                     {}};
  KeyTable true_values{
      "true_values",
      false,
      "true value of a number of the plant that differs from the scene's, for which "
      "the controller is designed; a default that is computed from the scene's "
      "number stays",
      {}};
  tolerance.of_others = true;
  true_values.of_others = true;
  for (const Variable& each : variables(tables)) {
    const std::string meaning = fmt::format("true value of {}", each.name);
    const Rule absent{"the scene's value"};
    tolerance.keys.push_back({each.name, {}, spread_of(each.allowed), absent, meaning, each.uses});
    true_values.keys.push_back({each.name, {}, each.allowed, absent, meaning, each.uses});
  }
  tables.push_back(std::move(tolerance));
  tables.push_back(std::move(true_values));
}

}  // namespace

const std::vector<KeyTable>& key_tables() {
  static const std::vector<KeyTable> tables = [] {
    std::vector<KeyTable> all = plain_tables();
    add_tables_of_others(all);
    return all;
  }();
  return tables;
}

const KeyTable* find_table(std::string_view name) {
  const auto& tables = key_tables();
  const auto found = std::find_if(tables.begin(), tables.end(),
                                  [&](const KeyTable& table) { return table.name == name; });
  return found == tables.end() ? nullptr : &*found;
}

const Key* find_key(const KeyTable& table, std::string_view name) {
  const auto found = std::find_if(table.keys.begin(), table.keys.end(),
                                  [&](const Key& key) { return key.name == name; });
  return found == table.keys.end() ? nullptr : &*found;
}

const KeyTable& key_table(std::string_view name) {
  if (const KeyTable* table = find_table(name)) {
    return *table;
  }
  throw std::logic_error(fmt::format("no table {} is described", name));
}

const Key& key_of(const KeyTable& table, std::string_view name) {
  if (const Key* key = find_key(table, name)) {
    return *key;
  }
  throw std::logic_error(fmt::format("no key {}.{} is described", table.name, name));
}

std::string_view unit_of(const Key& key) {
  return unit_in(key.allowed);
}

}  // namespace sonoglide::scene_file
