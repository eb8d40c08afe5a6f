/// What a study writes.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace sonoglide::output {

/// What a study leaves behind.
struct StudyReport {
  std::map<std::string, std::string> files;  ///< content by name; an empty one is none
  std::string text;                          ///< for the terminal
};

/// Writes the files, all or none, and takes away an earlier one of the name of one that is empty.
/// @throws process::FileError
void write(const std::filesystem::path& folder, const StudyReport& report);

}  // namespace sonoglide::output
