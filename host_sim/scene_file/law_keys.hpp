/// The keys that friction laws have of their own.
#pragma once

#include <vector>

#include "host_sim/scene_file/keys.hpp"

namespace sonoglide::scene_file {

/// Adds each once, as the laws describe them; laws may share a key.
void add_law_keys(std::vector<Key>& keys);

}  // namespace sonoglide::scene_file
