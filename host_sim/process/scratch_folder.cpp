#include "host_sim/process/scratch_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "host_sim/process/printable.hpp"

namespace sonoglide::process {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view name_end = "XXXXXX";
constexpr const char* mark = ".scratch";

Descriptor open_folder(const fs::path& path) {
  return Descriptor(open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

/// Whether the open folder still stands under its name.
bool stands(const Descriptor& folder, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(folder.number(), &opened) == 0 && lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

bool has_the_name(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::string_view begin = ScratchFolder::name_begin;
  return name.size() == begin.size() + name_end.size() && name.rfind(begin, 0) == 0;
}

/// Whoever was killed before it left its mark had put nothing else in.
bool is_ours(const fs::path& path) {
  std::error_code unknown;
  return fs::exists(path / mark, unknown) || fs::is_empty(path, unknown);
}

/// What killed processes have left.
void remove_orphans(const fs::path& parent) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, ignored)) {
    if (!has_the_name(entry.path())) {
      continue;
    }
    const Descriptor folder = open_folder(entry.path());
    if (folder.number() >= 0 && flock(folder.number(), LOCK_EX | LOCK_NB) == 0 &&
        is_ours(entry.path())) {
      fs::remove_all(entry.path(), ignored);
    }
  }
}

}  // namespace

ScratchError::ScratchError(const std::string& path, std::string reason)
    : ProcessError(process::printable(path) + ": cannot be created: " + reason),
      reason_(std::move(reason)) {}

ScratchFolder::ScratchFolder(const fs::path& parent) {
  remove_orphans(parent);
  do {
    std::string name = (parent / ScratchFolder::name_begin).string() + std::string(name_end);
    if (mkdtemp(name.data()) == nullptr) {
      throw ScratchError(name, std::strerror(errno));
    }
    path_ = name;
    lock_ = open_folder(path_);
    if (lock_.number() < 0) {
      throw ScratchError(name, std::strerror(errno));
    }
    flock(lock_.number(), LOCK_EX);
    // Until it was locked, another process could take it for an orphan.
  } while (!stands(lock_, path_));
  const Descriptor file(open((path_ / mark).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace sonoglide::process
