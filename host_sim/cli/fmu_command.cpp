#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/fmi/archive/make_fmu.hpp"
#include "host_sim/output/output_folder.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/stepped/engine.hpp"

namespace sonoglide::cli {
namespace {

struct FmuOptions {
  SceneOptions scene;
  std::string kind;
  int version = 3;
  bool clock = false;
  std::string out;
  bool quiet = false;
};

stepped::Kind kind_of(const std::string& name) {
  for (const scene::Named<stepped::Kind>& each : stepped::kinds) {
    if (each.name == name) {
      return each.value;
    }
  }
  return stepped::Kind::loop;
}

void write(const FmuOptions& options) {
  if (options.clock && options.version != 3) {
    throw CLI::ValidationError("--clock", "is of FMI 3 alone; allowed: --fmi 3");
  }
  const SceneInput input(options.scene);
  const scene::Scene scene = input.read();
  const fmi::Content content{kind_of(options.kind), options.clock};
  input.with_places([&] {
    stepped::require_usable(scene, content.kind);
    return options.clock ? fmi::clock_resolution_Hz(scene) : 0;
  });
  const std::filesystem::path out = std::filesystem::absolute(options.out);
  output::OutputFolder folder(out.parent_path(), {out.filename().string()});
  folder.write(
      out.filename().string(),
      fmi::make_fmu(scene, content, options.version == 2 ? fmi::Version::fmi2 : fmi::Version::fmi3,
                    fmi::find_parts(), "sonoglide " SONOGLIDE_VERSION));
  folder.commit();
  if (!options.quiet) {
    if (content.kind != stepped::Kind::plant) {
      print_design_notes(configure::design_if_closed(scene));
    }
    fmt::print("fmu:  {}\nstep: {} s, one carrier period\n", process::printable(options.out),
               1.0 / scene.drive->frequency_Hz);
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
      ->check(CLI::IsMember({"plant", "controller", "loop"}));
  command->add_option("--fmi", options->version, "Version of the interface [3]")
      ->type_name("3|2")
      ->check(CLI::IsMember({2, 3}));
  command->add_flag("--clock", options->clock,
                    "With event mode and a clock that ticks once a carrier period");
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
