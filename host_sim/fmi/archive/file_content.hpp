/// What goes into an FMU as it is.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "host_sim/output/written_files.hpp"

namespace sonoglide::fmi {

/// @throws output::OutputError  it cannot be read
inline std::string file_content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) {
    output::fail(path, "cannot be read");
  }
  return content;
}

}  // namespace sonoglide::fmi
