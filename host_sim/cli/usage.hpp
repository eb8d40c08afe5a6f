/// What a command line names that no command knows.
#pragma once

#include <CLI/CLI.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace sonoglide::cli {

/// what() has a line for each word that is wrong, in their order: what is wrong, and the known one
/// that is nearest or all that are allowed.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The commands inside one, in the order of its help; those that the help hides are left out.
std::vector<const CLI::App*> commands_of(const CLI::App& command);

/// The command of this name inside one, hidden ones too, or none.
const CLI::App* command_named(const CLI::App& command, const std::string& name);

/// Looks for unknown commands, unknown options and superfluous arguments, before anything else is
/// found wrong with the words: the parser would name what is missing first, and what is unknown
/// from behind. A call for help is not looked at.
/// @param program  with all its commands and options
/// @throws UsageError
void require_known_words(const CLI::App& program, int argument_count, const char* const* arguments);

}  // namespace sonoglide::cli
