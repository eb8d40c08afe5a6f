#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "host_sim/cli/identify_commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/identify/impedance/read_sweep.hpp"
#include "host_sim/studies/identify/impedance/report.hpp"
#include "host_sim/studies/identify/impedance/study.hpp"
#include "host_sim/studies/identify/text_file.hpp"

namespace sonoglide::cli {
namespace {

namespace impedance = identify::impedance;

struct ImpedanceOptions {
  std::string file;
  std::optional<double> mass_kg;
  std::optional<double> force_factor_N_per_V;
  std::string out;  ///< empty: out/<file name>_impedance
  bool quiet = false;
};

std::string check_range(const std::string& text, const impedance::Range& range) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && value >= range.least && value <= range.most
             ? std::string()
             : fmt::format("\"{}\"; allowed: {:g} to {:g}", text, range.least, range.most);
}

std::string check_mass(const std::string& text) {
  return check_range(text, impedance::mass_range_kg);
}

std::string check_force_factor(const std::string& text) {
  return check_range(text, impedance::force_factor_range_N_per_V);
}

/// Throws scene_file::SceneError, loop::ComputationError, output::OutputError,
/// process::ProcessError; in each case nothing was written.
void identify_impedance(const ImpedanceOptions& options) {
  const scene_file::Source source = identify::read_text(options.file);
  const impedance::Sweep sweep = impedance::read_sweep(source);
  const std::filesystem::path out = output_folder(options.out, source.name(), "_impedance");
  output::require_gnuplot();
  require_writable(out, {"report.html", "identify.json", "fit.csv", "scene.toml"});
  const impedance::ImpedanceStudy study =
      impedance::study(source.name(), sweep, {options.mass_kg, options.force_factor_N_per_V});
  impedance::write(out, study);
  if (!options.quiet) {
    fmt::print("{}", impedance::text(study, out));
  }
}

}  // namespace

void add_identify_impedance_command(CLI::App& group) {
  const auto options = std::make_shared<ImpedanceOptions>();
  CLI::App* command = group.add_subcommand(
      "impedance", "Equivalent circuit of a transducer from a measured sweep of its impedance");
  command
      ->add_option("file", options->file,
                   "The sweep: a table with named columns, Touchstone .s1p, or the text of an "
                   "Agilent 4294A")
      ->required()
      ->type_name("FILE");
  CLI::Option* mass = command
                          ->add_option("--mass-kg", options->mass_kg,
                                       "The moving mass, from which the force factor follows")
                          ->type_name("M")
                          ->check(check_mass);
  command
      ->add_option("--force-factor-N-per-V", options->force_factor_N_per_V,
                   "The force factor, from which the moving mass follows")
      ->type_name("N")
      ->check(check_force_factor)
      ->excludes(mass);
  add_output_option(*command, options->out,
                    "report.html, identify.json, fit.csv and, with a mechanical fact, scene.toml "
                    "[out/<file name>_impedance]");
  command->add_flag("--quiet", options->quiet, "No printed summary");
  command->callback([options] { identify_impedance(*options); });
}

}  // namespace sonoglide::cli
