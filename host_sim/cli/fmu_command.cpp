#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/fmi/archive/make_fmu.hpp"
#include "host_sim/loop/stepped.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::cli {
namespace {

struct FmuOptions {
  SceneOptions scene;
  std::string kind;
  std::string version{fmi::versions.front().name};
  std::string out;
  bool quiet = false;
};

void write(const FmuOptions& options) {
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  const scene::Scene& scene = experiment.plant;
  const loop::Kind kind = *scene::value_of(loop::kinds, options.kind);
  input.with_places([&] { loop::require_usable(scene, kind); });
  const std::filesystem::path out = std::filesystem::absolute(options.out);
  process::OutputFolder folder(out.parent_path(), {out.filename().string()});
  const fmi::Parts parts = fmi::find_parts(fmi::folder_of_program());
  folder.write(
      out.filename().string(),
      fmi::make_fmu(experiment.nominal, kind, *scene::value_of(fmi::versions, options.version),
                    parts, "sonoglide " SONOGLIDE_VERSION));
  folder.commit();
  if (!options.quiet) {
    if (kind != loop::Kind::plant) {
      print_design_notes(experiment.design);
    }
    fmt::print("fmu:  {}\nstep: {} s, one carrier period{}\n", process::printable(options.out),
               1.0 / scene.drive->frequency_Hz, scene.carrier_changes() ? " at the start" : "");
    if (!parts.windows_engine) {
      fmt::print(
          "note: without a binary for Windows: the program was built without "
          "SONOGLIDE_FMU_WINDOWS\n");
    }
  }
}

}  // namespace

void add_fmu_command(CLI::App& program) {
  const auto options = std::make_shared<FmuOptions>();
  CLI::App* command = program.add_subcommand(
      "fmu", "Write a scene's plant, controller or closed loop as an FMU for co-simulation");
  add_scene_options(*command, options->scene);
  command->add_option("--kind", options->kind, "What of the scene the FMU holds")
      ->required()
      ->type_name("plant|controller|loop")
      ->check(one_of({"plant", "controller", "loop"}));
  command->add_option("--fmi", options->version, "Version of the interface [3]")
      ->type_name("3|2")
      ->check(one_of({"3", "2"}));
  command->add_option("--out", options->out, "The FMU")
      ->required()
      ->type_name("FILE.fmu")
      ->check([](const std::string& file) {
        return std::filesystem::path(file).extension() == ".fmu"
                   ? std::string()
                   : std::string("is no name of an FMU; allowed: a file that ends in .fmu");
      });
  command->add_flag("--quiet", options->quiet, "No notes, and no word on where the FMU is");
  command->callback([options] { write(*options); });
}

}  // namespace sonoglide::cli
