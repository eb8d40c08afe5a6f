/// The sources that an FMU carries, and how they are built.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sonoglide::fmi {

struct SourceText {
  std::string name;  ///< relative to the source tree, with / between folders
  std::string text;
};

/// Headers and translation units of the engine, sorted by name. What CMake makes of templates is
/// made here too.
/// @param tree  the source tree
/// @throws output::OutputError  one of them cannot be read
std::vector<SourceText> engine_sources(const std::filesystem::path& tree);

/// sources/buildDescription.xml, of FMI 3.0.
std::string build_description(const std::vector<SourceText>& sources,
                              const std::string& identifier);

}  // namespace sonoglide::fmi
