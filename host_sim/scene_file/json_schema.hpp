/// The JSON Schema of scenes, by which editors complete and check them.
#pragma once

#include <string>

namespace sonoglide::scene_file {

/// Draft 4, which the TOML language servers read. It refuses unknown keys, wrong types, words and
/// numbers out of range. What depends on other keys it leaves to the reader. The text ends with a
/// newline.
std::string json_schema();

}  // namespace sonoglide::scene_file
