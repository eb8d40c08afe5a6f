#include <CLI/CLI.hpp>

#include <memory>
#include <string>

#include "host_sim/cli/identify_commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::cli {
namespace {

struct ImpedanceOptions {
  std::string file;
  std::string out;  ///< empty: out/<file name>_impedance
  bool quiet = false;
};

void identify_impedance(const ImpedanceOptions& options) {
  identify::read_text(options.file);
}

}  // namespace

void add_identify_impedance_command(CLI::App& group) {
  const auto options = std::make_shared<ImpedanceOptions>();
  CLI::App* command = group.add_subcommand(
      "impedance", "Equivalent circuit of a transducer from a measured sweep of its impedance");
  command->add_option("file", options->file, "The sweep, as an instrument or a spreadsheet has it")
      ->required()
      ->type_name("FILE");
  add_output_option(*command, options->out,
                    "report.html and identify.json [out/<file name>_impedance]");
  command->add_flag("--quiet", options->quiet, "No printed summary");
  command->callback([options] { identify_impedance(*options); });
}

}  // namespace sonoglide::cli
