#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "host_sim/cli/options.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/studies/paper/figures.hpp"

namespace sonoglide::cli {
namespace {

struct PaperOptions {
  std::string out = "out/paper";
  std::optional<int> figure;
  bool quiet = false;
};

std::string check_figure(const std::string& text) {
  std::string allowed;
  for (const paper::NumberedFigure& each : paper::figure_list()) {
    const std::string number = std::to_string(each.number);
    if (text == number) {
      return {};
    }
    allowed += fmt::format("{}{}", allowed.empty() ? "" : ", ", number);
  }
  return fmt::format("\"{}\" is no figure; allowed: {}", text, allowed);
}

/// Throws process::FileError, process::ProcessError, loop::ComputationError; in each case nothing
/// was written.
void paper(const PaperOptions& options) {
  output::require_gnuplot();
  with_bar(options.quiet, [&](const auto& progress) {
    paper::write_paper(options.out, options.figure, progress);
  });
  if (!options.quiet) {
    fmt::print("page: {}\n",
               process::printable((std::filesystem::path(options.out) / "index.html").string()));
  }
}

}  // namespace

void add_paper_command(CLI::App& program) {
  const auto options = std::make_shared<PaperOptions>();
  CLI::App* command = program.add_subcommand(
      "paper", "The figures and the energy balance of Bharadwaj and Dapino (2013), checked");
  add_output_option(
      *command, options->out,
      "index.html, balance.csv, table_1.toml, table_2.toml, of each figure figure_NN.csv "
      "and .svg, of figure 12 measurements.csv and scenes [out/paper]");
  command->add_option("--figure", options->figure, "This figure alone")
      ->type_name("N")
      ->check(check_figure);
  command->add_flag("--quiet", options->quiet, "No progress bar and no printed summary");
  command->callback([options] { paper(*options); });
}

}  // namespace sonoglide::cli
