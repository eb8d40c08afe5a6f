/// What of a scene is inside an FMU, beside the engine.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/loop/stepped.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::fmi {

/// The texts in the folder resources/ of an FMU.
struct Resources {
  static constexpr const char* scene_name = "scene.toml";
  static constexpr const char* kind_name = "kind.txt";
  static constexpr const char* token_name = "token.txt";

  std::string scene;  ///< with every default filled in, as TOML
  loop::Kind kind;
  std::string token;  ///< that an importer shows; another for another FMU
};

/// @param engine  content of the shared libraries that go into the FMU
Resources make_resources(const scene::Scene& scene, loop::Kind kind, const std::string& engine);

/// @throws std::runtime_error  one of them cannot be read, or is none
Resources read_resources(const std::filesystem::path& folder);

}  // namespace sonoglide::fmi
