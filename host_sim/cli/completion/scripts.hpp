/// Scripts by which a shell completes the words of a command line.
#pragma once

#include <string>
#include <vector>

#include "host_sim/cli/completion/command_tree.hpp"

namespace sonoglide::completion {

// Each offers the commands, their options, the words and files that these take, and the keys of a
// scene after --set and --vary.

/// To be sourced, or in the folder that bash-completion reads.
std::string bash_script(const std::vector<Command>& tree, const std::vector<std::string>& keys);
/// In a folder of $fpath as `_sonoglide`, or to be sourced after compinit.
std::string zsh_script(const std::vector<Command>& tree, const std::vector<std::string>& keys);
/// To be sourced, or in a completions folder of fish.
std::string fish_script(const std::vector<Command>& tree, const std::vector<std::string>& keys);

}  // namespace sonoglide::completion
