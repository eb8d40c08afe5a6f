/// The sample of "How to add a command".
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "host_sim/cli/options.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/process/printable.hpp"
#include "tests/acceptance/cli/samples/natural_mode.hpp"
#include "tests/acceptance/cli/samples/sample_commands.hpp"

namespace sonoglide::cli {
namespace {

struct NaturalModeOptions {
  SceneOptions scene;
  std::string out;  ///< empty: out/<scene name>_natural_mode
  bool quiet = false;
};

void natural_mode(const NaturalModeOptions& options) {
  const SceneInput input(options.scene);
  const scene::Scene scene = input.read().plant;
  const std::string table = input.with_places([&] { return natural_mode::table(scene); });
  const std::filesystem::path out = output_folder(options.out, scene.name, "_natural_mode");
  process::OutputFolder folder(out);
  folder.write("natural_mode.csv", table);
  folder.commit();
  if (!options.quiet) {
    fmt::print("table: {}\n", process::printable((out / "natural_mode.csv").string()));
  }
}

}  // namespace

void add_natural_mode_command(CLI::App& program) {
  const auto options = std::make_shared<NaturalModeOptions>();
  CLI::App* command =
      program.add_subcommand("natural-mode", "Frequency of the natural mode of a scene's plant");
  add_scene_options(*command, options->scene, "its plant alone plays a part");
  add_output_option(*command, options->out, "natural_mode.csv [out/<scene name>_natural_mode]");
  command->add_flag("--quiet", options->quiet, "No word on where the table is");
  command->callback([options] { natural_mode(*options); });
}

}  // namespace sonoglide::cli
