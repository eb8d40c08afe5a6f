#include "host_sim/cli/paper_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <set>

#include "host_sim/cli/output_option.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/paper/figures.hpp"
#include "host_sim/paper/paper.hpp"
#include "host_sim/plot/gnuplot.hpp"

namespace sonoglide::cli {
namespace {

std::set<int> figure_numbers() {
  std::set<int> numbers;
  for (const paper::NumberedFigure& each : paper::figure_list()) {
    numbers.insert(each.number);
  }
  return numbers;
}

void compute(const PaperOptions& options) {
  ProgressBar bar(stderr, !options.quiet);
  paper::write_paper(options.out, options.figure, [&bar](double part) { bar.update(part); });
}

}  // namespace

CLI::App* add_paper_command(CLI::App& program, PaperOptions& options) {
  CLI::App* command = program.add_subcommand(
      "paper", "The figures and the energy balance of Bharadwaj and Dapino (2013), checked");
  add_output_option(
      *command, options.out,
      "index.html, balance.csv, table_1.toml, table_2.toml, of each figure figure_NN.csv "
      "and .svg, of figure 12 measurements.csv and scenes [paper]");
  command->add_option("--figure", options.figure, "This figure alone")
      ->check(CLI::IsMember(figure_numbers()));
  command->add_flag("--quiet", options.quiet, "No progress bar and no printed summary");
  return command;
}

void paper(const PaperOptions& options) {
  plot::require_gnuplot();
  compute(options);
  if (!options.quiet) {
    fmt::print("page: {}\n", (std::filesystem::path(options.out) / "index.html").string());
  }
}

}  // namespace sonoglide::cli
