#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::cli {
namespace {

struct ConfigureOptions {
  SceneOptions scene;
  std::string out;    ///< empty: out/<scene name>
  std::string plant;  ///< its arithmetic; empty: no plant
  bool quiet = false;
};

/// Throws scene_file::SceneError, process::FileError; in each case nothing was written.
void configure(const ConfigureOptions& options) {
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  const std::filesystem::path out = output_folder(options.out, experiment.plant.name);
  process::OutputFolder folder(out);
  folder.write(emulated::controller_header_name,
               input.with_places([&] { return emulated::controller_header(experiment); }));
  if (options.plant.empty()) {
    folder.withdraw(emulated::plant_header_name);
  } else {
    const auto arithmetic = *scene::value_of(emulated::plant_arithmetics, options.plant);
    folder.write(emulated::plant_header_name,
                 input.with_places([&] { return emulated::plant_header(experiment, arithmetic); }));
  }
  folder.commit();
  if (!options.quiet) {
    print_design_notes(experiment.design);
    fmt::print("header: {}\n",
               process::printable((out / emulated::controller_header_name).string()));
    if (!options.plant.empty()) {
      fmt::print("plant:  {}\n", process::printable((out / emulated::plant_header_name).string()));
    }
  }
}

}  // namespace

void add_configure_command(CLI::App& program) {
  const auto options = std::make_shared<ConfigureOptions>();
  CLI::App* command = program.add_subcommand(
      "configure", "Write the controller of a closed-loop scene as a header for its image");
  add_scene_options(*command, options->scene);
  add_output_option(*command, options->out,
                    fmt::format("{} [out/<scene name>]", emulated::controller_header_name));
  command
      ->add_option("--plant", options->plant,
                   fmt::format("Write the plant as well, in this arithmetic, as {}: for an image "
                               "that holds both",
                               emulated::plant_header_name))
      ->type_name("float32|q31")
      ->check(one_of({"float32", "q31"}));
  command->add_flag("--quiet", options->quiet, "No notes, and no word on where the header is");
  command->callback([options] { configure(*options); });
}

}  // namespace sonoglide::cli
