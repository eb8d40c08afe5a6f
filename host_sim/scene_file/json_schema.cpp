#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host_sim/scene_file/key_reference.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/table_cursor.hpp"

namespace sonoglide::scene_file {
namespace {

using nlohmann::ordered_json;

ordered_json number_schema(const Range& range) {
  ordered_json schema{{"type", "number"}, {"minimum", range.low}};
  if (range.low_open) {
    schema["exclusiveMinimum"] = true;
  }
  schema["maximum"] = range.high;
  return schema;
}

/// The schema of a value by what it may be.
struct ValueSchema {
  ordered_json operator()(const Number& number) const { return number_schema(number.range); }
  ordered_json operator()(const Integer& integer) const {
    return {{"type", "integer"}, {"minimum", integer.low}, {"maximum", integer.high}};
  }
  ordered_json operator()(const Word& word) const {
    return {{"type", "string"}, {"enum", word.allowed}};
  }
  ordered_json operator()(const WordList& list) const {
    return {{"type", "array"},
            {"uniqueItems", true},
            {"items", {{"type", "string"}, {"enum", list.allowed}}}};
  }
  ordered_json operator()(const Profile& profile) const {
    ordered_json pair{{"type", "array"}, {"minItems", 2}, {"maxItems", 2}};
    pair["items"] =
        ordered_json::array({number_schema(profile.time), number_schema(profile.value)});
    return {{"type", "array"}, {"minItems", 1}, {"items", pair}};
  }
  ordered_json operator()(const Interval& interval) const {
    return {{"type", "array"},
            {"minItems", 2},
            {"maxItems", 2},
            {"items", number_schema(interval.range)}};
  }
  ordered_json operator()(const TextureTable& texture) const {
    const auto points = [](const Range& range) {
      return ordered_json{{"type", "array"},
                          {"minItems", TableCursor::fewest_points},
                          {"maxItems", TableCursor::most_points},
                          {"items", number_schema(range)}};
    };
    return {{"type", "object"},
            {"additionalProperties", false},
            {"required", ordered_json::array({"period_m"})},
            {"oneOf", ordered_json::array({{{"required", ordered_json::array({"ratio"})}},
                                           {{"required", ordered_json::array({"force_N"})}}})},
            {"properties",
             {{"period_m", number_schema(texture.period)},
              {"ratio", points(texture.ratio)},
              {"force_N", points(texture.force)}}}};
  }
  ordered_json operator()(const Truth& /*truth*/) const {
    return {{"type", "boolean"}, {"default", true}};
  }
  ordered_json operator()(const Spread& spread) const {
    ordered_json bound = number_schema(spread.range);
    if (spread.whole) {
      bound["type"] = "integer";
    }
    ordered_json range = single_key(
        "range", {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", bound}});
    if (spread.whole) {
      return range;
    }
    const ordered_json amount = number_schema(spread_range);
    return {{"anyOf", ordered_json::array({amount, single_key("normal", amount), range})}};
  }

 private:
  /// A table with this key alone.
  static ordered_json single_key(const char* key, const ordered_json& value) {
    return {{"type", "object"},
            {"additionalProperties", false},
            {"required", ordered_json::array({key})},
            {"properties", {{key, value}}}};
  }
};

void add_default(ordered_json& schema, const Key& key) {
  if (const auto* number = std::get_if<double>(&key.absent)) {
    if (std::holds_alternative<Integer>(key.allowed)) {
      schema["default"] = static_cast<std::int64_t>(*number);
    } else {
      schema["default"] = *number;
    }
  } else if (const auto* word = std::get_if<std::string_view>(&key.absent)) {
    schema["default"] = *word;
  }
}

/// Meaning, default and use, a sentence each.
std::string description(const Key& key) {
  const std::string absent = absent_text(key);
  const bool required = absent.rfind("required", 0) == 0;
  const std::string used = key.used_text();
  return fmt::format("{} {}{}", sentence(key.meaning),
                     sentence(required ? absent : fmt::format("Default: {}", absent)),
                     used.empty() ? "" : fmt::format(" Used with {}.", used));
}

ordered_json key_schema(const Key& key) {
  const std::string_view unit = unit_of(key);
  ordered_json schema{
      {"title", unit.empty() ? std::string(key.name) : fmt::format("{} [{}]", key.name, unit)},
      {"description", description(key)}};
  schema.update(std::visit(ValueSchema{}, key.allowed));
  add_default(schema, key);
  return schema;
}

/// The keys that must be there whatever the rest of the scene, and those of which one must be.
void add_required(ordered_json& schema, const std::vector<Key>& keys) {
  for (const Key& key : keys) {
    if (std::holds_alternative<Required>(key.absent) && key.used_text().empty()) {
      schema["required"].push_back(key.name);
    }
  }
  for (const Key& key : keys) {
    if (std::holds_alternative<Instead>(key.absent)) {
      schema["oneOf"].push_back({{"required", {key.name}}});
    }
  }
}

ordered_json table_schema(const KeyTable& table) {
  ordered_json schema{{"title", fmt::format("[{}]", table.name)},
                      {"description", sentence(table.meaning)},
                      {"type", "object"},
                      {"additionalProperties", false}};
  add_required(schema, table.keys);
  for (const Key& key : table.keys) {
    schema["properties"][std::string(key.name)] = key_schema(key);
  }
  return schema;
}

}  // namespace

std::string json_schema() {
  ordered_json schema{{"$schema", "http://json-schema.org/draft-04/schema#"},
                      {"title", "Scene of sonoglide"},
                      {"type", "object"},
                      {"additionalProperties", false}};
  schema["oneOf"] = {{{"required", {"sliding"}}}, {{"required", {"load"}}}};
  for (const KeyTable& table : key_tables()) {
    if (table.required && table.has == nullptr) {
      schema["required"].push_back(table.name);
    }
    schema["properties"][std::string(table.name)] = table_schema(table);
  }
  return schema.dump(2) + "\n";
}

}  // namespace sonoglide::scene_file
