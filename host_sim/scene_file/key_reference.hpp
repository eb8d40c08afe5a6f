/// The reference of scene keys, host_sim/scenes/keys.md.
#pragma once

#include <string>

namespace sonoglide::scene_file {

/// The whole file, in Markdown: a table for each table of a scene.
std::string key_reference();

}  // namespace sonoglide::scene_file
