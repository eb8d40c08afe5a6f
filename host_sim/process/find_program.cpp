#include "host_sim/process/find_program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "host_sim/process/process_error.hpp"

namespace sonoglide::process {

std::filesystem::path require_program(const std::string& program, const std::string& package) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::filesystem::path candidate = std::filesystem::path(folder) / program;
    if (access(candidate.c_str(), X_OK) == 0) {
      return candidate;
    }
  }
  throw ProcessError(
      fmt::format("{}: is not installed; on Debian: apt-get install {}", program, package));
}

}  // namespace sonoglide::process
