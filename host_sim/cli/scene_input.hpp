/// The scene of a command, the same for every command that takes one.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/scene_file/reader.hpp"

namespace sonoglide::cli {

struct SceneOptions {
  std::string path;  ///< `-`: standard input
  std::vector<std::string> overrides;
};

/// Adds the scene, required, and `--set` to a command.
/// @param note  what of the scene plays no part, or nothing
void add_scene_options(CLI::App& command, SceneOptions& options, const std::string& note = "");

/// The scene that the options name, its text read once.
class SceneInput {
 public:
  /// @param options  outlive this
  /// @throws scene::SceneError  the text cannot be read
  explicit SceneInput(const SceneOptions& options);

  /// @throws scene::SceneError
  scene::Scene read() const { return scene_file::read(source_, options_.overrides); }

  /// What a call makes of the scene that read() gave.
  /// @throws scene::SceneError  at the place of its key, where the call throws a
  ///         scene::ConfigurationError
  template <class Call>
  auto with_places(const Call& call) const {
    try {
      return call();
    } catch (const configure::ConfigurationError& error) {
      throw placed(error);
    }
  }

 private:
  scene_file::SceneError placed(const configure::ConfigurationError& error) const;

  const SceneOptions& options_;
  scene_file::Source source_;
};

}  // namespace sonoglide::cli
