#include "host_sim/scene_file/key_reference.hpp"

#include <fmt/format.h>

#include "host_sim/scene_file/key_text.hpp"
#include "host_sim/scene_file/keys.hpp"

namespace sonoglide::scene_file {
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
                     allowed_text(key), absent_text(key), key.meaning, key.used);
}

std::string section(const KeyTable& table) {
  std::string text = fmt::format("\n## `[{}]`\n\n{}{}\n\n", table.name, sentence(table.meaning),
                                 table.required ? " Required." : "");
  text += "| key | unit | allowed | default | meaning | used with |\n|---|---|---|---|---|---|\n";
  for (const Key& key : table.keys) {
    text += row(key);
  }
  return text;
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
