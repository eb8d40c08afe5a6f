/// `sonoglide configure`: the controller of a scene as the header that an image is built with.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "host_sim/cli/scene_input.hpp"

namespace sonoglide::cli {

struct ConfigureOptions {
  SceneOptions scene;
  std::string out;    ///< empty: out/<scene name>
  std::string plant;  ///< its arithmetic; empty: no plant
  bool quiet = false;
};

/// Adds the command to the program; `options` outlives it and is filled in by parsing.
CLI::App* add_configure_command(CLI::App& program, ConfigureOptions& options);

/// Throws scene::SceneError, report::OutputError; in each case nothing was written.
void configure(const ConfigureOptions& options);

}  // namespace sonoglide::cli
