#include "host_sim/scene_file/echo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/document.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/law_keys.hpp"
#include "host_sim/scene_file/override.hpp"

namespace sonoglide::scene_file {
namespace {

using nlohmann::ordered_json;

bool is_constant(const std::vector<scene::SpeedPoint>& points) {
  return points.size() == 1 && points.front().time_s == 0.0;
}

/// The value of one key as the scene has it; null where that has none.
class Echo {
 public:
  Echo(scene::Scene& scene, const Key& key) : scene_(scene), key_(key) {}

  ordered_json operator()(std::monostate /*nowhere*/) const { return nullptr; }
  template <class Value>
  ordered_json operator()(Of<Value> value) const {
    return value(scene_);
  }
  template <class Value>
  ordered_json operator()(Of<std::optional<Value>> value) const {
    return value(scene_) ? ordered_json(*value(scene_)) : nullptr;
  }
  ordered_json operator()(OrZero number) const {
    return number.number(scene_) != 0.0 ? ordered_json(number.number(scene_)) : nullptr;
  }
  ordered_json operator()(Choice choice) const {
    const std::optional<std::size_t> index = choice.index(scene_);
    return index ? ordered_json(std::get<Word>(key_.allowed).allowed[*index]) : nullptr;
  }
  ordered_json operator()(Of<std::vector<scene::Channel>> channels) const {
    ordered_json words;
    for (const scene::Channel each : channels(scene_)) {
      words.push_back(scene::name_of(scene::channels, each));
    }
    return words;
  }
  ordered_json operator()(Of<std::optional<scene::FrequencyRange>> range) const {
    const auto& ends = range(scene_);
    return ends ? ordered_json::array({ends->lowest_Hz, ends->highest_Hz}) : nullptr;
  }
  ordered_json operator()(Of<std::optional<scene::Texture>> member) const {
    const std::optional<scene::Texture>& texture = member(scene_);
    return texture ? ordered_json{{"period_m", texture->period_m},
                                  {texture->of_force ? "force_N" : "ratio", texture->values}}
                   : nullptr;
  }
  ordered_json operator()(Of<scene::TimedProfile> profile) const { return rows(profile(scene_)); }
  ordered_json operator()(InPlaceOf level) const { return rows(level.profile(scene_)); }
  ordered_json operator()(Of<std::vector<scene::SpeedPoint>> points) const {
    const std::vector<scene::SpeedPoint>& all = points(scene_);
    const bool is_told = &all == &scene_.sliding.profile && is_constant(all);  // as one velocity
    return is_told ? nullptr : rows(all);
  }
  ordered_json operator()(ConstantSpeed constant) const {
    const std::vector<scene::SpeedPoint>& points = constant.profile(scene_);
    return is_constant(points) ? ordered_json(points.front().velocity_m_per_s) : nullptr;
  }
  ordered_json operator()(Of<std::vector<scene::TargetStep>> steps) const {
    return rows(steps(scene_));
  }
  ordered_json operator()(Periods /*in_seconds*/) const { return nullptr; }
  ordered_json operator()(OwnOfLaw /*law*/) const {
    const OwnKeys keys = own_keys(scene_.friction.law);
    const OwnKey& own = *keys.find(key_.name);
    return own.count != nullptr ? ordered_json(*own.count) : ordered_json(*own.number);
  }

 private:
  template <class Row>
  static ordered_json rows(const std::vector<Row>& rows) {
    ordered_json pairs;
    for (const auto& [time_s, value] : rows) {
      pairs.push_back(ordered_json::array({time_s, value}));
    }
    return pairs;
  }

  scene::Scene& scene_;
  const Key& key_;
};

ordered_json echo(scene::Scene& scene, const Key& key) {
  return key.used(scene) ? std::visit(Echo(scene, key), key.member) : nullptr;
}

/// A key that the echo has further down than the list, before another or at the end of its table.
struct Lowered {
  std::string_view table;
  std::string_view key;
  std::string_view before;
};
constexpr std::array<Lowered, 2> lowered_keys = {
    {{"friction", "sign_convention", ""}, {"run", "start", "record"}}};

std::vector<const Key*> in_echo_order(const KeyTable& table) {
  std::vector<const Key*> keys;
  for (const Key& key : table.keys) {
    keys.push_back(&key);
  }
  for (const Lowered& lowered : lowered_keys) {
    const auto named = [&keys](std::string_view name) {
      return std::find_if(keys.begin(), keys.end(),
                          [name](const Key* key) { return key->name == name; });
    };
    if (lowered.table == table.name) {
      const auto key = named(lowered.key);
      std::rotate(key, key + 1, named(lowered.before));
    }
  }
  return keys;
}

ordered_json echo(scene::Scene& scene, const KeyTable& table) {
  ordered_json values = ordered_json::object();
  for (const Key* key : in_echo_order(table)) {
    const std::vector<std::string_view> others = key->others();
    const bool replaced = std::any_of(others.begin(), others.end(), [&](std::string_view other) {
      return !echo(scene, key_of(table, other)).is_null();
    });
    ordered_json value = replaced ? nullptr : echo(scene, *key);
    if (!value.is_null()) {
      values[std::string(key->name)] = std::move(value);
    }
  }
  return values;
}

ordered_json number(double value, bool whole) {
  return whole ? ordered_json(static_cast<std::int64_t>(value)) : ordered_json(value);
}

ordered_json spread(const scene::Tolerance& tolerance) {
  switch (tolerance.spread) {
    case scene::Spread::half_width:
      return tolerance.amount;
    case scene::Spread::normal:
      return {{"normal", tolerance.amount}};
    case scene::Spread::range:
      break;
  }
  return {{"range", ordered_json::array({number(tolerance.lowest, tolerance.whole),
                                         number(tolerance.highest, tolerance.whole)})}};
}

void add_truth(ordered_json& root, const scene::Scene& scene) {
  for (const scene::Tolerance& each : scene.tolerances) {
    root["tolerance"][each.key] = spread(each);
  }
  for (const scene::TrueValue& each : scene.true_values) {
    root["true_values"][each.key] = number(each.value, each.whole);
  }
}

bool is_there(const scene::Scene& scene, const KeyTable& table) {
  return !table.of_others && (table.has == nullptr || table.has(scene)) &&
         std::all_of(table.uses.begin(), table.uses.end(),
                     [&scene](const Use& use) { return use.holds(scene); });
}

/// @param scene  a copy: the list of keys gives places that may be written to
ordered_json stated(scene::Scene scene) {
  ordered_json root;
  for (const KeyTable& table : key_tables()) {
    if (is_there(scene, table)) {
      root[std::string(table.name)] = echo(scene, table);
    }
  }
  return root;
}

/// A dot would part the key.
std::string key_text(const std::string& key) {
  return key.find('.') == std::string::npos ? key : fmt::format("\"{}\"", key);
}

/// JSON's numbers, strings, truths and arrays are TOML as they are.
std::string value_text(const ordered_json& value) {
  if (!value.is_object()) {
    return value.dump();
  }
  std::string text;
  for (const auto& [key, member] : value.items()) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key_text(key), value_text(member));
  }
  return fmt::format("{{ {} }}", text);
}

/// Null where the document does not give the key.
ordered_json value_of(const Document& document, const OverriddenKey& target) {
  const SceneTable* table = document.find(target.table);
  if (table == nullptr || table->entries.count(target.key) == 0) {
    return nullptr;
  }
  std::ostringstream text;
  text << toml::json_formatter(*table->entries.at(target.key).value);
  return ordered_json::parse(text.str());
}

}  // namespace

ordered_json to_json(const scene::Scene& scene) {
  ordered_json root = stated(scene);
  add_truth(root, scene);
  return root;
}

std::string to_toml(const ordered_json& echo) {
  std::string text;
  for (const auto& [table, values] : echo.items()) {
    text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", table);
    for (const auto& [key, value] : values.items()) {
      text += fmt::format("{} = {}\n", key_text(key), value_text(value));
    }
  }
  return text;
}

ordered_json changes(const Source& source, const std::vector<std::string>& overrides) {
  ordered_json changed = ordered_json::object();
  const Document in_file(source);
  const Document in_run(source, overrides);
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const OverriddenKey target = parse_override(overrides[i], i + 1).target;
    const ordered_json before = value_of(in_file, target);
    const ordered_json now = value_of(in_run, target);
    if (before != now) {
      changed[target.table + '.' + target.key] = {{"file", before}, {"value", now}};
    }
  }
  return changed;
}

}  // namespace sonoglide::scene_file
