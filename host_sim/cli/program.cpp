#include "host_sim/cli/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string_view>

#include "host_sim/cli/arithmetic_command.hpp"
#include "host_sim/cli/configure_command.hpp"
#include "host_sim/cli/design_command.hpp"
#include "host_sim/cli/exit_code.hpp"
#include "host_sim/cli/paper_command.hpp"
#include "host_sim/cli/pil_command.hpp"
#include "host_sim/cli/ratio_command.hpp"
#include "host_sim/cli/run_command.hpp"
#include "host_sim/cli/schema_command.hpp"
#include "host_sim/cli/stability_command.hpp"
#include "host_sim/cli/sweep_command.hpp"
#include "host_sim/cli/usage.hpp"
#include "host_sim/cli/work_precision_command.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/output/output_folder.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/text/printable.hpp"

namespace sonoglide::cli {
namespace {

/// A full disk or a closed pipe shows only when the buffer goes out.
void flush_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw output::OutputError("standard output: cannot be written");
  }
}

void parse_and_run(int argument_count, const char* const* arguments) {
  CLI::App program("Ultrasonic friction control: simulation of plant and controller", "sonoglide");
  program.set_version_flag("--version", "sonoglide " SONOGLIDE_VERSION);
  program.require_subcommand(0, 1);
  RunOptions run_options;
  PilOptions pil_options;
  ConfigureOptions configure_options;
  RatioOptions ratio_options;
  SweepOptions sweep_options;
  PaperOptions paper_options;
  WorkPrecisionOptions work_precision_options;
  StabilityOptions stability_options;
  ArithmeticOptions arithmetic_options;
  DesignOptions design_options;
  add_run_command(program, run_options)->callback([&] { run(run_options); });
  add_pil_command(program, pil_options)->callback([&] { pil(pil_options); });
  add_configure_command(program, configure_options)->callback([&] {
    configure(configure_options);
  });
  add_ratio_command(program, ratio_options)->callback([&] { ratio(ratio_options); });
  add_sweep_command(program, sweep_options)->callback([&] { sweep(sweep_options); });
  add_paper_command(program, paper_options)->callback([&] { paper(paper_options); });
  add_work_precision_command(program, work_precision_options)->callback([&] {
    work_precision(work_precision_options);
  });
  add_stability_command(program, stability_options)->callback([&] {
    stability(stability_options);
  });
  add_arithmetic_command(program, arithmetic_options)->callback([&] {
    arithmetic(arithmetic_options);
  });
  add_design_command(program, design_options)->callback([&] { design(design_options); });
  add_schema_command(program)->callback([] { schema(); });
  require_known_words(program, argument_count, arguments);
  try {
    program.parse(argument_count, arguments);
    if (program.get_subcommands().empty()) {
      throw CLI::RequiredError("a command");
    }
  } catch (const CLI::Success& request) {
    program.exit(request);
  }
  flush_output();
}

/// Names of files and words of other programs get no say in what the terminal does.
int fail(ExitCode code, std::string_view message) {
  fmt::print(stderr, "{}\n", text::printable_lines(message));
  return code;
}

int fail_usage(std::string_view message) {
  return fail(
      bad_input,
      fmt::format("sonoglide: {}\nsonoglide --help lists the commands and their options", message));
}

}  // namespace

int run_program(int argument_count, const char* const* arguments) {
  try {
    parse_and_run(argument_count, arguments);
    return done;
  } catch (const CLI::ParseError& error) {
    return fail_usage(text::printable(error.what()));
  } catch (const UsageError& error) {
    return fail_usage(error.what());
  } catch (const scene_file::SceneError& error) {
    return fail(bad_input, error.what());
  } catch (const loop::ComputationError& error) {
    return fail(computation_failed, error.what());
  } catch (const std::exception& error) {
    return fail(system_failed, error.what());
  }
}

}  // namespace sonoglide::cli
