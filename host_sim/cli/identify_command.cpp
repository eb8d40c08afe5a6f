#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/studies/identify/friction/comparison.hpp"
#include "host_sim/studies/identify/impedance/study.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"
#include "host_sim/studies/identify/text_file.hpp"

namespace sonoglide::cli {
namespace {

namespace impedance = identify::impedance;
namespace fitting = identify::friction;

struct IdentifyOptions {
  std::string file;
  impedance::MechanicalFact fact;
  std::vector<std::string> laws;
  StudyOptions study;
};

/// Throws scene_file::SceneError, loop::ComputationError, process::FileError,
/// process::ProcessError; in each case nothing was written.
void identify_impedance(const IdentifyOptions& options) {
  const scene_file::Source source = identify::read_text(options.file);
  const impedance::Sweep sweep = impedance::read_sweep(source);
  run_study(
      options.study, output_folder(options.study.out, source.name(), "_impedance"),
      {"report.html", "identify.json", "fit.csv", "scene.toml"},
      [&](const auto&) { return impedance::study(source.name(), sweep, options.fact); },
      impedance::report);
}

/// Throws scene_file::SceneError, process::FileError; in each case nothing was written.
void identify_friction(const IdentifyOptions& options) {
  const scene_file::Source source = identify::read_text(options.file);
  const fitting::Readings readings = fitting::read_readings(source);
  run_study(
      options.study, output_folder(options.study.out, source.name(), "_friction"),
      {"report.html", "identify.json", "scene.toml"},
      [&](const auto& progress) { return fitting::compare(readings, options.laws, progress); },
      [&](const auto& comparison) { return fitting::report(comparison, source.name()); });
}

CLI::App* add_command(CLI::App& group, const std::string& name, const std::string& description,
                      IdentifyOptions& options, const std::string& file) {
  CLI::App* command = group.add_subcommand(name, description);
  command->add_option("file", options.file, file)->required()->type_name("FILE");
  return command;
}

void add_impedance_command(CLI::App& group) {
  const auto options = std::make_shared<IdentifyOptions>();
  CLI::App* command = add_command(
      group, "impedance",
      "Equivalent circuit of a transducer from a measured sweep of its impedance", *options,
      "The sweep: a table with named columns, Touchstone .s1p, or the text of an "
      "Agilent 4294A");
  CLI::Option* mass =
      command
          ->add_option("--mass-kg", options->fact.mass_kg,
                       "The moving mass, from which the force factor follows")
          ->type_name("M")
          ->check(in_range(impedance::mass_range_kg.least, impedance::mass_range_kg.most));
  command
      ->add_option("--force-factor-N-per-V", options->fact.force_factor_N_per_V,
                   "The force factor, from which the moving mass follows")
      ->type_name("N")
      ->check(in_range(impedance::force_factor_range_N_per_V.least,
                       impedance::force_factor_range_N_per_V.most))
      ->excludes(mass);
  add_study_options(*command, options->study,
                    "report.html, identify.json, fit.csv and, with a mechanical fact, scene.toml "
                    "[out/<file name>_impedance]",
                    "No printed summary");
  command->callback([options] { identify_impedance(*options); });
}

void add_friction_command(CLI::App& group) {
  const auto options = std::make_shared<IdentifyOptions>();
  CLI::App* command = add_command(
      group, "friction", "Friction laws fitted to measured friction under vibration, and compared",
      *options,
      "A table with sliding_velocity_m_per_s, vibration_velocity_m_per_s or "
      "velocity_ratio, and friction_ratio or friction_force_N");
  command->add_option("--law", options->laws, "Fit this law alone; repeatable")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->check(fitting::check_law);
  add_study_options(*command, options->study,
                    "report.html, identify.json and scene.toml [out/<file name>_friction]");
  command->callback([options] { identify_friction(*options); });
}

}  // namespace

void add_identify_command(CLI::App& program) {
  CLI::App* group = program.add_subcommand(
      "identify", "Parameters of a plant from measurements, each with its 95 % interval");
  group->require_subcommand(1);
  add_impedance_command(*group);
  add_friction_command(*group);
}

}  // namespace sonoglide::cli
