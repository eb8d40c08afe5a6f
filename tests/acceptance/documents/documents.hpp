/// The documents of a folder: that of the sources, or one in which they are installed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sonoglide::acceptance {

std::vector<std::filesystem::path> documents_in(const std::filesystem::path& root);

std::vector<std::string> lines_of(const std::filesystem::path& document);

std::string joined(const std::vector<std::string>& lines);

}  // namespace sonoglide::acceptance
