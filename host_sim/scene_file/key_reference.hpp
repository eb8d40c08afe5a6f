/// The scene keys in words, for the documentation and the schema.
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

}  // namespace sonoglide::scene_file
