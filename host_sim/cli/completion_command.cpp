#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <string>

#include "host_sim/cli/commands.hpp"

namespace sonoglide::cli {
namespace {

// Each script asks the program itself, by `complete`.

/// Bash itself would split words at = and :, and wants of a word only what stands behind the last.
constexpr const char* bash_script =
    R"(# Completion of sonoglide in bash. Written by: sonoglide completion bash
_sonoglide() {
  local line=${COMP_LINE:0:COMP_POINT} kind="" offered=""
  local -a words
  read -a words <<<"$line"
  [[ $line == *[[:blank:]] ]] && words+=("")
  local word=${words[-1]}
  { read -r kind; offered=$(cut -f 1); } < <("${1/#\~/$HOME}" complete -- "${words[@]:1}" 2>/dev/null)
  case $kind in files) compopt -o default ;; folders) compopt -o dirnames ;; esac
  mapfile -t COMPREPLY < <(compgen -W "$offered" -- "$word")
  [[ $COMP_WORDBREAKS == *=* ]] && COMPREPLY=("${COMPREPLY[@]#"${word%"${word##*[=:]}"}"}")
  [[ ${COMPREPLY-} == *= ]] && compopt -o nospace
  return 0
}
complete -F _sonoglide sonoglide
)";

/// As a file of $fpath the script runs in the call; sourced, it is registered.
constexpr const char* zsh_script =
    R"(#compdef sonoglide
# Completion of sonoglide in zsh. Written by: sonoglide completion zsh
_sonoglide() {
  local -a offered=("${(@f)$(${~words[1]} complete -- "${(@)words[2,CURRENT-1]}" "$PREFIX" 2>/dev/null)}")
  local kind=$offered[1]
  offered=("${(@)${(@)offered[2,-1]//:/\\:}/$'\t'/:}")
  case $kind in
    files) _files ;;
    folders) _files -/ ;;
    words) _describe word offered ;;
    keys) _describe 'key of a scene' offered -S '' ;;
  esac
}
if [[ $funcstack[1] == _sonoglide ]]; then _sonoglide "$@"; else compdef _sonoglide sonoglide; fi
)";

constexpr const char* fish_script =
    R"(# Completion of sonoglide in fish. Written by: sonoglide completion fish
function __sonoglide_offered
    set -l words (commandline -opc) (commandline -ct)
    set -l program (string replace -r '^~' $HOME -- $words[1])
    set -l offered ($program complete -- $words[2..-1] 2>/dev/null)
    switch "$offered[1]"
        case files; __fish_complete_path (commandline -ct)
        case folders; __fish_complete_directories (commandline -ct)
        case words keys; printf '%s\n' $offered[2..-1]
    end
end
complete -c sonoglide -f -a '(__sonoglide_offered)'
)";

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
  command->callback([shell] {
    fmt::print("{}", *shell == "bash" ? bash_script : *shell == "zsh" ? zsh_script : fish_script);
  });
}

}  // namespace sonoglide::cli
