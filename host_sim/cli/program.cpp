#include "host_sim/cli/program.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "host_sim/boards/emulated/lockstep_image.hpp"
#include "host_sim/cli/usage.hpp"
#include "host_sim/long_work/collection.hpp"
#include "host_sim/long_work/slurm.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/output/program.hpp"
#include "host_sim/process/ending.hpp"
#include "host_sim/process/file_error.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::cli {
namespace {

/// As a shell takes it, but for what is not printable.
std::string command_line(int argument_count, const char* const* arguments) {
  std::string line = "sonoglide";
  for (int i = 1; i < argument_count; ++i) {
    line += ' ' + long_work::shell_word(arguments[i]);
  }
  return process::printable(line);
}

void parse_and_run(int argument_count, const char* const* arguments,
                   const std::vector<AddCommand>& command_list) {
  CLI::App program("Ultrasonic friction control: simulation of plant and controller", "sonoglide");
  program.set_version_flag("--version", "sonoglide " SONOGLIDE_VERSION);
  program.require_subcommand(0, 1);
  for (const AddCommand add_command : command_list) {
    add_command(program);
  }
  require_known_words(program, argument_count, arguments);
  output::program().command_line = command_line(argument_count, arguments);
  try {
    program.parse(argument_count, arguments);
    if (program.get_subcommands().empty()) {
      throw CLI::CallForHelp();
    }
  } catch (const CLI::Success& request) {
    program.exit(request);
  }
  flush_output();
}

std::string unwritten_output(const std::string& reason) {
  return "standard output: cannot be written: " + reason;
}

/// Of what no command is known to throw.
constexpr const char* unexpected = "an error of the program itself, which should be reported";

int fail(ExitCode code, std::string_view message) {
  process::show_on_stderr(message);
  return code;
}

/// Where the command that the arguments name is explained, or all of them.
std::string hint(int argument_count, const char* const* arguments,
                 const std::vector<AddCommand>& command_list) {
  CLI::App program;
  for (const AddCommand add_command : command_list) {
    add_command(program);
  }
  std::string name = "sonoglide";
  const CLI::App* command = &program;
  for (int i = 1; i < argument_count; ++i) {
    const CLI::App* named = command_named(*command, arguments[i]);
    if (named == nullptr) {
      break;
    }
    command = named;
    name += ' ' + command->get_name();
  }
  const bool is_group = !commands_of(*command).empty();
  return fmt::format("{} --help lists the {}", name, is_group ? "commands" : "options");
}

}  // namespace

void flush_output() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw process::FileError(
        unwritten_output(errno == 0 ? "no reason given" : std::generic_category().message(errno)));
  }
}

int run_program(int argument_count, const char* const* arguments,
                const std::vector<AddCommand>& command_list) {
  process::fill_closed_streams();
  const process::SignalWatch signals;
  const auto fail_usage = [&](std::string_view message) {
    return fail(bad_input, fmt::format("sonoglide: {}\n{}", message,
                                       hint(argument_count, arguments, command_list)));
  };
  try {
    parse_and_run(argument_count, arguments, command_list);
    return done;
  } catch (const CLI::ExcludesError& error) {
    return fail_usage(fmt::format("{}; allowed: one of the two", error.what()));
  } catch (const CLI::ParseError& error) {
    return fail_usage(process::printable(error.what()));
  } catch (const UsageError& error) {
    return fail_usage(error.what());
  } catch (const scene_file::SceneError& error) {
    return fail(bad_input, error.what());
  } catch (const loop::ComputationError& error) {
    return fail(computation_failed, error.what());
  } catch (const long_work::Incomplete& error) {
    return fail(computation_failed, error.what());
  } catch (const process::FileError& error) {
    return fail(system_failed, error.what());
  } catch (const process::ProcessError& error) {
    return fail(system_failed, error.what());
  } catch (const emulated::ImageError& error) {
    return fail(system_failed, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(system_failed, error.path1().string() + ": " + error.code().message());
  } catch (const std::system_error& error) {
    return fail(system_failed, std::ferror(stdout) != 0
                                   ? unwritten_output(error.code().message())
                                   : fmt::format("sonoglide: {}: {}", unexpected, error.what()));
  } catch (const std::bad_alloc&) {
    return fail(system_failed, "sonoglide: the memory is not enough; allowed: a smaller task");
  } catch (const std::exception& error) {
    return fail(system_failed, fmt::format("sonoglide: {}: {}", unexpected, error.what()));
  }
}

}  // namespace sonoglide::cli
