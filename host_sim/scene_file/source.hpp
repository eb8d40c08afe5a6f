/// Where a scene's text comes from.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::scene_file {

/// The text of a scene, read once.
struct Source {
  /// What errors show as the file of a scene from standard input.
  static constexpr const char* standard_input = "<stdin>";

  std::string file;
  std::string text;

  /// The scene's name: the file's, printable and without folder and ending; `stdin` for a scene
  /// from there. `scene` and `worst`, as studies call the scenes that they write, are the same in
  /// every folder, so that the name of the folder comes before them: `FOLDER_scene`.
  std::string name() const;
};

/// @param path  a file, or `-` for standard input
/// @throws SceneError  it cannot be read, or is larger than a scene may be
Source read_source(const std::filesystem::path& path);

}  // namespace sonoglide::scene_file
