#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "host_sim/cli/completion/scripts.hpp"

namespace sonoglide::completion {
namespace {

constexpr std::string_view fish_head =
    R"(# Completion of sonoglide in fish. Written by: sonoglide completion fish

# The command line begins with these words of a command.
function __sonoglide_in
    set -l words (commandline -opc)
    string match -q -- (string join " " sonoglide $argv "*") "sonoglide $words[2..-1] "
end

function __sonoglide_at
    __sonoglide_in $argv; and test (count (commandline -opc)) -eq (math (count $argv) + 1)
end

complete -c sonoglide -f
)";

std::string fish_quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) {
    safe += c == '\'' || c == '\\' ? std::string{'\\', c} : std::string{c};
  }
  return safe + "'";
}

/// Flags of `complete` for what follows.
std::string fish_offer(const Value& value) {
  switch (value.kind) {
    case Kind::words:
      return fmt::format(" -x -a '{}'", fmt::join(value.words, " "));
    case Kind::scene_keys:
      return " -x -a \"$__sonoglide_keys\"";
    case Kind::file:
      return " -r -F";
    case Kind::folder:
      return " -x -a '(__fish_complete_directories)'";
    case Kind::text:
      return " -x";
    case Kind::none:
      break;
  }
  return "";
}

std::string fish_lines_of(const Command& command) {
  std::string text;
  for (const Word& each : command.commands) {
    text += fmt::format("complete -c sonoglide -n '__sonoglide_at {}' -a {} -d {}\n", command.path,
                        each.name, fish_quoted(each.meaning));
  }
  if (command.argument.kind != Kind::none) {
    text += fmt::format("complete -c sonoglide -n '__sonoglide_in {}'{}\n", command.path,
                        fish_offer(command.argument));
  }
  for (const Option& option : command.options) {
    const std::string_view place = command.path.empty() ? "at" : "in";
    text += fmt::format("complete -c sonoglide -n '__sonoglide_{} {}' -l {} -d {}{}\n", place,
                        command.path, option.name.substr(2), fish_quoted(option.meaning),
                        fish_offer(option.value));
  }
  return text;
}

}  // namespace

std::string fish_script(const std::vector<Command>& tree, const std::vector<std::string>& keys) {
  std::string text(fish_head);
  text += fmt::format("set -g __sonoglide_keys {}\n", fmt::join(keys, " "));
  for (const Command& command : tree) {
    text += fish_lines_of(command);
  }
  return text;
}

}  // namespace sonoglide::completion
