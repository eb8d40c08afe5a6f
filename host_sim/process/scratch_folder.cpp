#include "host_sim/process/scratch_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "host_sim/process/process_error.hpp"

namespace sonoglide::process {

ScratchFolder::ScratchFolder(const std::filesystem::path& parent) {
  std::string name = (parent / ".sonoglide-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw ProcessError(name + ": cannot be created: " + std::strerror(errno));
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace sonoglide::process
