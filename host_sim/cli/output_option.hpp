/// The option that names the folder to write to, the same for every command that has one.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace sonoglide::cli {

/// Adds `--out DIR` to a command; an empty name is an error of usage.
/// @param contents  what the folder will hold, and in brackets where it is by default
void add_output_option(CLI::App& command, std::string& out, const std::string& contents);

/// @param out  as the option has it; empty where it was not given: then out/NAME in the working
///             folder
std::filesystem::path output_folder(const std::string& out, const std::string& name);

/// Finds out, before results are computed, that an output cannot be written: stages and removes an
/// empty folder.
/// @throws report::OutputError
void require_writable(const std::filesystem::path& out);

}  // namespace sonoglide::cli
