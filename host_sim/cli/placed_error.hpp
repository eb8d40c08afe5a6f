/// Where in its file a scene is wrong, if that shows only after reading.
#pragma once

#include <string>
#include <vector>

#include "host_sim/scene/configuration_error.hpp"
#include "host_sim/scene/scene_error.hpp"

namespace sonoglide::cli {

/// The error, at the place of its key in a scene file and overrides that were read without
/// complaint.
scene::SceneError placed(const scene::ConfigurationError& error, const std::string& path,
                         const std::vector<std::string>& overrides);

/// What a call makes of a scene that was read from `path`, with the overrides.
/// @throws scene::SceneError  where the call throws a scene::ConfigurationError
template <class Call>
auto with_places(const std::string& path, const Call& call,
                 const std::vector<std::string>& overrides = {}) {
  try {
    return call();
  } catch (const scene::ConfigurationError& error) {
    throw placed(error, path, overrides);
  }
}

}  // namespace sonoglide::cli
