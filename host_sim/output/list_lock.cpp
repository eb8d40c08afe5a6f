#include "host_sim/output/list_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "host_sim/output/written_files.hpp"

namespace sonoglide::output {

ListLock::ListLock(const std::filesystem::path& folder, Kind kind)
    : list_(folder / WrittenFiles::file_name) {
  constexpr mode_t mode = 0666;
  const bool alone = kind == Kind::alone;
  do {
    // A lock on the writers of a network's file system takes a file that is open for writing.
    file_ = process::Descriptor(
        open(list_.c_str(), (alone ? O_RDWR : O_RDONLY) | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC));
    began_ = false;
    if (file_.number() < 0 && errno == ENOENT && alone) {
      file_ = process::Descriptor(open(list_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode));
      began_ = file_.number() >= 0;
      if (!began_ && errno == EEXIST) {
        continue;
      }
    }
    if (file_.number() < 0 || !process::lock(file_, alone ? LOCK_EX : LOCK_SH)) {
      return;
    }
    // Who held it may have put another in its place.
  } while (!process::stands(file_, list_));
}

ListLock::~ListLock() {
  if (began_ && process::stands(file_, list_)) {
    unlink(list_.c_str());
  }
}

void ListLock::hold_next(const std::filesystem::path& list) {
  next_ = process::Descriptor(open(list.c_str(), O_RDWR | O_CLOEXEC));
  process::lock(next_, LOCK_EX);
}

}  // namespace sonoglide::output
