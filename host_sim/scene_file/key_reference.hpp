/// The scene keys in words and as a schema.
#pragma once

#include <string>

#include "host_sim/scene_file/keys.hpp"

namespace sonoglide::scene_file {

/// What the key may hold, without the unit: `1e-12 to 1e+06`.
std::string allowed_text(const Key& key);

/// What holds without the key: its default, `required`, or a rule.
std::string absent_text(const Key& key);

/// With a final stop, and a capital unless it begins with a word of a scene: `given: …`.
std::string sentence(std::string text);

/// The whole file, in Markdown: a table for each table of a scene.
std::string key_reference();

/// The JSON Schema of scenes, by which editors complete and check them.
///
/// Draft 4, which the TOML language servers read. It refuses unknown keys, wrong types, words and
/// numbers out of range. What depends on other keys it leaves to the reader. The text ends with a
/// newline.
std::string json_schema();

}  // namespace sonoglide::scene_file
