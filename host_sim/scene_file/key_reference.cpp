#include "host_sim/scene_file/key_reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "host_sim/scene/cores/solver_choice.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/table_cursor.hpp"

namespace sonoglide::scene_file {
namespace {

/// Its bounds alone.
std::string bounds(const Range& range) {
  return Range{range.low, range.high, "", range.low_open}.text();
}

struct AllowedText {
  std::string operator()(const Number& number) const { return bounds(number.range); }
  std::string operator()(const Integer& integer) const {
    return fmt::format("integer, {} to {}", integer.low, integer.high);
  }
  std::string operator()(const Word& word) const {
    return fmt::format("\"{}\"", fmt::join(word.allowed, "\", \""));
  }
  std::string operator()(const WordList& list) const {
    return fmt::format("list of \"{}\"", fmt::join(list.allowed, "\", \""));
  }
  std::string operator()(const Profile& profile) const {
    return fmt::format("`[[time in s, value], ...]`; time {}, value {}", bounds(profile.time),
                       bounds(profile.value));
  }
  std::string operator()(const Interval& interval) const {
    return fmt::format("`[lowest, highest]`, {}", bounds(interval.range));
  }
  std::string operator()(const Truth& /*truth*/) const { return "true, false"; }
  std::string operator()(const TextureTable& texture) const {
    return fmt::format(
        "`{{ period_m = length, ratio = [value, ...] }}`; length {}, {} to {} values {}; or "
        "`force_N` in place of `ratio`, values {}",
        bounds(texture.period), TableCursor::fewest_points, TableCursor::most_points,
        bounds(texture.ratio), bounds(texture.force));
  }
  std::string operator()(const Spread& spread) const {
    const std::string range =
        fmt::format("`{{ range = [lowest, highest] }}`, {}", bounds(spread.range));
    return spread.whole ? range
                        : fmt::format("half width, {0}; `{{ normal = deviation }}`, {0}; {1}",
                                      bounds(spread_range), range);
  }
};

struct AbsentText {
  std::string operator()(const Required& /*required*/) const { return "required"; }
  std::string operator()(const Instead& instead) const {
    return fmt::format("required, or {}", instead.others);
  }
  std::string operator()(double number) const { return fmt::format("{}", number); }
  std::string operator()(std::string_view word) const { return fmt::format("\"{}\"", word); }
  std::string operator()(const Rule& rule) const { return rule.words; }
};

}  // namespace

std::string allowed_text(const Key& key) {
  return std::visit(AllowedText{}, key.allowed);
}

std::string absent_text(const Key& key) {
  return std::visit(AbsentText{}, key.absent);
}

std::string sentence(std::string text) {
  const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz");
  const bool of_a_scene = end != std::string::npos && (text[end] == '_' || text[end] == ':');
  if (!text.empty() && end > 0 && !of_a_scene) {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text + ".";
}

namespace {

constexpr std::string_view introduction =
    R"(<!-- Written by the target write_keys from host_sim/scene_file/keys.cpp and scene/laws. -->

# Reference of the keys of a scene

A scene is a TOML file. Numbers are in SI units, and the unit is in the name of the key. An integer
is accepted where a real number is meant. A key that the chosen law, method or mode does not use is
an error. "Used with" is empty for a key that every scene may have; open loop is a scene without a
table `[controller]`, closed loop a scene with one.

The laws are explained in [friction laws](../../firmware/friction/README.md), the controller in
[control](../../firmware/control/README.md). [scene.schema.json](scene.schema.json) holds the same
list as a JSON Schema.
)";

std::string row(const Key& key) {
  const std::string_view unit = unit_of(key);
  return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, unit.empty() ? "-" : unit,
                     allowed_text(key), absent_text(key), key.meaning, key.used_text());
}

std::string list_of(const KeyTable& table, bool whole) {
  std::vector<std::string_view> names;
  for (const Key& key : table.keys) {
    const auto* spread = std::get_if<Spread>(&key.allowed);
    const bool is_whole =
        spread != nullptr ? spread->whole : std::holds_alternative<Integer>(key.allowed);
    if (is_whole == whole) {
      names.push_back(key.name);
    }
  }
  return fmt::format("`\"{}\"`", fmt::join(names, "\"`, `\""));
}

/// What the values may be, and which keys there are.
std::string keys_in_words(const KeyTable& table) {
  const bool spreads = std::holds_alternative<Spread>(table.keys.front().allowed);
  std::string text =
      "A key has quotes, since it is `TABLE.KEY` of another table, where the scene has to have a "
      "value of it. ";
  text += spreads ? fmt::format(
                        "Its value is a half width relative to the scene's value, {0}; or "
                        "`{{ normal = deviation }}`, a standard deviation relative to it, {0}; or "
                        "`{{ range = [lowest, highest] }}`, two values that the key may have.",
                        bounds(spread_range))
                  : std::string("Its value is one that the key may have there.");
  return text + fmt::format("\n\nReal numbers: {}.\n\nIntegers{}: {}.\n", list_of(table, false),
                            spreads ? ", with a range alone" : "", list_of(table, true));
}

/// The laws that each method solves.
std::string methods_of_laws() {
  std::string text = "\nMethods by friction law:\n\n| law | methods |\n|---|---|\n";
  for (const auto& law : scene::friction_laws) {
    std::vector<std::string> methods;
    for (const auto& method : scene::solver_methods) {
      if (scene::solves(method.value, law.value)) {
        methods.push_back(fmt::format("`{}`", method.name));
      }
    }
    text += fmt::format("| `{}` | {} |\n", law.name, fmt::join(methods, ", "));
  }
  return text;
}

std::string section(const KeyTable& table) {
  std::string text = fmt::format("\n## `[{}]`\n\n{}{}\n\n", table.name, sentence(table.meaning),
                                 table.required && table.has == nullptr ? " Required." : "");
  if (table.of_others) {
    return text + keys_in_words(table);
  }
  text += "| key | unit | allowed | default | meaning | used with |\n|---|---|---|---|---|---|\n";
  for (const Key& key : table.keys) {
    text += row(key);
  }
  return table.name == "solver" ? text + methods_of_laws() : text;
}

}  // namespace

std::string key_reference() {
  std::string text(introduction);
  for (const KeyTable& table : key_tables()) {
    text += section(table);
  }
  return text;
}

}  // namespace sonoglide::scene_file
