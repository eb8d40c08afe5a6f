#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <string>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/completion/scripts.hpp"

namespace sonoglide::cli {
namespace {

/// The script alone.
void completion(const CLI::App& program, const std::string& shell) {
  const auto write = shell == "bash"  ? completion::bash_script
                     : shell == "zsh" ? completion::zsh_script
                                      : completion::fish_script;
  fmt::print("{}", write(completion::command_tree(program), completion::scene_keys()));
}

}  // namespace

void add_completion_command(CLI::App& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand(
      "completion", "Script by which a shell completes commands, options, boards and scene keys");
  command->add_option("shell", *shell, "The shell")
      ->required()
      ->type_name("bash|zsh|fish")
      ->check([](const std::string& name) {
        return name == "bash" || name == "zsh" || name == "fish"
                   ? std::string()
                   : fmt::format("\"{}\" is no shell known here; allowed: bash, zsh, fish", name);
      });
  command->callback([&program, shell] { completion(program, *shell); });
}

}  // namespace sonoglide::cli
