#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "host_sim/cli/completion/scripts.hpp"

namespace sonoglide::completion {
namespace {

constexpr std::string_view bash_head =
    R"(# Completion of sonoglide in bash. Written by: sonoglide completion bash

# Words are split here at blanks alone: bash would split them at = and : as well.
_sonoglide() {
  local -a words
  read -ra words <<<"${COMP_LINE:0:COMP_POINT}"
  [[ ${COMP_LINE:0:COMP_POINT} == *[[:blank:]] ]] && words+=("")
  local last=$((${#words[@]} - 1)) command="" previous="" offered="" kind=words i
  local word=${words[last]}
  for ((i = 1; i < last; ++i)); do
    previous=${words[i]}
    case "$command/$previous" in
)";

constexpr std::string_view bash_middle = R"(    esac
  done
  case "$command/$previous" in
)";

constexpr std::string_view bash_tail = R"(  esac
  COMPREPLY=()
  case $kind in
    file) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    folder) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    words) mapfile -t COMPREPLY < <(compgen -W "$offered" -- "$word") ;;
  esac
  # Bash has kept what stands before the last = or : of the word, and wants the rest alone.
  if [[ $kind == words && $COMP_WORDBREAKS == *=* && $word == *[=:]* ]]; then
    COMPREPLY=("${COMPREPLY[@]#"${word%"${word##*[=:]}"}"}")
  fi
  [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace
  return 0
}
complete -F _sonoglide sonoglide
)";

/// Sets `kind` and, of words, `offered`.
std::string bash_offer(const Value& value) {
  switch (value.kind) {
    case Kind::words:
      return fmt::format("offered=\"{}\"", fmt::join(value.words, " "));
    case Kind::scene_keys:
      return "offered=$_sonoglide_keys";
    case Kind::file:
      return "kind=file";
    case Kind::folder:
      return "kind=folder";
    case Kind::text:
    case Kind::none:
      break;
  }
  return "kind=text";
}

std::string bash_options_of(const Command& command) {
  std::string names;
  for (const Option& option : command.options) {
    names += (names.empty() ? "" : " ") + option.name;
  }
  return names;
}

/// Of a word that is no option's value: an option, or else a command or the argument.
std::string bash_offer_next(const Command& command) {
  std::vector<std::string> names;
  for (const Word& each : command.commands) {
    names.push_back(each.name);
  }
  const Value next = names.empty() ? command.argument : Value{Kind::words, names};
  return fmt::format("if [[ $word == -* ]]; then offered=\"{}\"; else {}; fi",
                     bash_options_of(command), bash_offer(next));
}

}  // namespace

std::string bash_script(const std::vector<Command>& tree, const std::vector<std::string>& keys) {
  std::string text(bash_head);
  for (const Command& command : tree) {
    for (const Word& each : command.commands) {
      text += fmt::format("      \"{}/{}\") command=\"{}{}{}\" ;;\n", command.path, each.name,
                          command.path, command.path.empty() ? "" : " ", each.name);
    }
  }
  text += bash_middle;
  for (const Command& command : tree) {
    for (const Option& option : command.options) {
      if (option.value.kind != Kind::none) {
        text += fmt::format("    \"{}/{}\") {} ;;\n", command.path, option.name,
                            bash_offer(option.value));
      }
    }
    text += fmt::format("    \"{}/\"*) {} ;;\n", command.path, bash_offer_next(command));
  }
  text += bash_tail;
  return text + fmt::format("_sonoglide_keys=\"\n{}\n\"\n", fmt::join(keys, "\n"));
}

}  // namespace sonoglide::completion
