#include "host_sim/process/scratch_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "host_sim/process/printable.hpp"

namespace sonoglide::process {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view name_end = "XXXXXX";
/// Of a folder that is not locked yet.
constexpr std::string_view unnamed_begin = ".sonoglide_new-";
constexpr const char* lock_file = ".lock";

/// Whether a name is this beginning and six characters.
bool begins(const fs::path& path, std::string_view begin) {
  const std::string name = path.filename().string();
  return name.size() == begin.size() + name_end.size() && name.rfind(begin, 0) == 0;
}

bool has_lock_file(const fs::path& folder) {
  std::error_code unknown;
  return fs::is_regular_file(fs::symlink_status(folder / lock_file, unknown));
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    paths.push_back(entry->path());
  }
  return paths;
}

/// The lock file goes last: what is left of a removal that is cut short is still an orphan.
void remove_folder(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& path : entries_of(folder)) {
    if (path.filename() != lock_file) {
      fs::remove_all(path, ignored);
    }
  }
  fs::remove_all(folder, ignored);
}

/// While others still write there.
void remove_in_use(const fs::path& folder) {
  constexpr int most_tries = 100;
  std::error_code unknown;
  for (int i = 0; i < most_tries && fs::exists(folder, unknown); ++i) {
    remove_folder(folder);
  }
}

bool has_owner(const fs::path& folder) {
  const Descriptor file(open((folder / lock_file).c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC));
  return file.number() < 0 || !lock(file, LOCK_EX | LOCK_NB);
}

/// Nobody takes so long between making a folder and locking it.
bool is_old(const fs::path& folder) {
  struct stat facts {};
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return lstat(folder.c_str(), &facts) == 0 &&
         std::chrono::seconds(now - facts.st_ctime) > std::chrono::hours(1);
}

/// A folder that has its name had its lock before: without a lock file, its owner was removing it.
bool is_orphan(const fs::path& folder, bool named) {
  if (has_lock_file(folder)) {
    return (named || is_old(folder)) && !has_owner(folder);
  }
  std::error_code unknown;
  return (named || is_old(folder)) && fs::is_directory(fs::symlink_status(folder, unknown)) &&
         fs::is_empty(folder, unknown);
}

/// What killed processes have left.
void remove_orphans(const fs::path& parent) {
  for (const fs::path& path : entries_of(parent)) {
    const bool named = begins(path, ScratchFolder::name_begin);
    if ((named || begins(path, unnamed_begin)) && is_orphan(path, named)) {
      remove_folder(path);
    }
  }
}

[[noreturn]] void fail(const fs::path& path, int error) {
  throw ScratchError(path.string(), std::strerror(error));
}

/// @return with the lock
Descriptor make_lock_file(const fs::path& folder) {
  constexpr mode_t mode = 0600;
  Descriptor file(open((folder / lock_file).c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (file.number() < 0) {
    const int error = errno;
    remove_folder(folder);
    fail(folder, error);
  }
  lock(file, LOCK_EX | LOCK_NB);
  return file;
}

}  // namespace

ScratchError::ScratchError(const std::string& path, std::string reason)
    : ProcessError(process::printable(path) + ": cannot be created: " + reason),
      reason_(std::move(reason)) {}

ScratchFolder::ScratchFolder(const fs::path& parent) {
  remove_orphans(parent);
  std::string name = (parent / unnamed_begin).string() + std::string(name_end);
  const Undisturbed now;
  if (mkdtemp(name.data()) == nullptr) {
    fail(name, errno);
  }
  lock_ = make_lock_file(name);
  path_ = parent / (name_begin + name.substr(name.size() - name_end.size()));
  // Should a folder of this name be there, it is not empty, and stays.
  if (rename(name.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    remove_folder(name);
    fail(path_, error);
  }
  undo_.emplace([path = path_] { remove_in_use(path); });
}

ScratchFolder::~ScratchFolder() {
  const Undisturbed now;
  remove_folder(path_);
  undo_.reset();
}

}  // namespace sonoglide::process
