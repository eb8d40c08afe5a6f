#include "host_sim/cli/scene_input.hpp"

#include "host_sim/scene_file/document.hpp"

namespace sonoglide::cli {

void add_scene_options(CLI::App& command, SceneOptions& options, const std::string& note) {
  command
      .add_option("scene", options.path,
                  "The scene, a TOML file, or - for standard input" +
                      (note.empty() ? std::string() : "; " + note))
      ->required()
      ->type_name("SCENE.toml");
  command
      .add_option("--set", options.overrides,
                  "Replace or add one value of the scene, e.g. drive.frequency_Hz=61e3, or, "
                  "without a value, remove it; repeatable")
      ->type_name("TABLE.KEY=VALUE")
      ->allow_extra_args(false);
}

SceneInput::SceneInput(const SceneOptions& options)
    : options_(options), source_(scene_file::read_source(options.path)) {}

scene_file::SceneError SceneInput::placed(const configure::ConfigurationError& error) const {
  return {scene_file::Document(source_, options_.overrides).place_of(error.key()), error.key(),
          error.what()};
}

}  // namespace sonoglide::cli
