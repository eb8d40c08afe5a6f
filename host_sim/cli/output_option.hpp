/// The option that names the folder to write to, the same for every command that has one.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace sonoglide::cli {

/// Adds `--out DIR` to a command; an empty name is an error of usage.
/// @param contents  what the folder will hold, and in brackets where it is by default
void add_output_option(CLI::App& command, std::string& out, const std::string& contents);

/// @param out  as the option has it; empty where it was not given: then out/NAMESUFFIX in the
///             working folder, where NAME is the scene's name as a plain folder can have it:
///             `scene` for one of nothing but dots, and one too long for a file system is cut, with
///             its checksum at the end
std::filesystem::path output_folder(const std::string& out, const std::string& scene_name,
                                    const std::string& suffix = "");

/// Finds out, before results are computed, that an output cannot be written: stages and removes an
/// empty folder.
/// @param names  of the files
/// @throws report::OutputError
void require_writable(const std::filesystem::path& out, const std::vector<std::string>& names);

}  // namespace sonoglide::cli
