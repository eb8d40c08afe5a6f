#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "host_sim/cli/completion/scripts.hpp"

namespace sonoglide::completion {
namespace {

constexpr std::string_view zsh_tail = R"(
# As a file of $fpath this runs in the call; sourced, it is registered.
if [[ $funcstack[1] == _sonoglide ]]; then
  _sonoglide "$@"
else
  compdef _sonoglide sonoglide
fi
)";

/// Inside single quotes, where _arguments and _describe give a colon and brackets a meaning.
std::string zsh_quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\'') {
      safe += "'\\''";
    } else {
      safe +=
          (c == ':' || c == '[' || c == ']' || c == '\\') ? std::string{'\\', c} : std::string{c};
    }
  }
  return safe;
}

/// `:name:action` of _arguments.
std::string zsh_action(const Value& value) {
  switch (value.kind) {
    case Kind::words:
      return fmt::format(":word:({})", fmt::join(value.words, " "));
    case Kind::scene_keys:
      return ":key of a scene:_sonoglide_scene_keys";
    case Kind::file:
      return ":file:_files";
    case Kind::folder:
      return ":folder:_files -/";
    case Kind::text:
      return ":value: ";
    case Kind::none:
      break;
  }
  return "";
}

std::string zsh_function_name(const std::string& path) {
  std::string name = "_sonoglide";
  for (const char c : path.empty() ? path : " " + path) {
    name += c == ' ' || c == '-' ? '_' : c;
  }
  return name;
}

std::string zsh_options_of(const Command& command) {
  std::string lines;
  for (const Option& option : command.options) {
    const bool repeatable = option.value.kind == Kind::scene_keys;
    lines += fmt::format("    '{}{}[{}]{}' \\\n", repeatable ? "*" : "", option.name,
                         zsh_quoted(option.meaning), zsh_action(option.value));
  }
  return lines;
}

std::string zsh_function_of(const Command& command) {
  const std::string name = zsh_function_name(command.path);
  if (command.commands.empty()) {
    return fmt::format(
        "\n{}() {{\n  _arguments \\\n{}    '1{}'\n}}\n", name, zsh_options_of(command),
        command.argument.kind == Kind::none ? ":nothing more: " : zsh_action(command.argument));
  }
  std::string text = fmt::format(
      "\n{}() {{\n  local state line\n  _arguments -C \\\n{}    '1: :->command' '*:: :->rest'\n"
      "  case $state in\n    command)\n      local -a commands=(\n",
      name, zsh_options_of(command));
  for (const Word& each : command.commands) {
    text += fmt::format("        '{}:{}'\n", each.name, zsh_quoted(each.meaning));
  }
  text += "      )\n      _describe command commands ;;\n    rest)\n      case $line[1] in\n";
  for (const Word& each : command.commands) {
    const std::string path = command.path.empty() ? each.name : command.path + " " + each.name;
    text += fmt::format("        {}) {} ;;\n", each.name, zsh_function_name(path));
  }
  return text + "      esac ;;\n  esac\n}\n";
}

}  // namespace

std::string zsh_script(const std::vector<Command>& tree, const std::vector<std::string>& keys) {
  std::string text =
      "#compdef sonoglide\n"
      "# Completion of sonoglide in zsh. Written by: sonoglide completion zsh\n\n"
      "_sonoglide_scene_keys() {\n  local -a keys=(\n";
  text += fmt::format("    {}\n  )\n  compadd -S '' -a keys\n}}\n", fmt::join(keys, "\n    "));
  for (const Command& command : tree) {
    text += zsh_function_of(command);
  }
  return text += zsh_tail;
}

}  // namespace sonoglide::completion
