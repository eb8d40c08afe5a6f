/// A folder for files that are not there to stay.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host_sim/process/ending.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {

/// No such folder can be created.
class ScratchError : public ProcessError {
 public:
  ScratchError(const std::string& path, std::string reason);
  /// Without the path.
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// A hidden folder of its own in another one, gone with its owner and all that is left in it, and
/// where a signal ends the program.
///
/// A process that is killed leaves its folder behind: the next ScratchFolder in the same parent
/// removes it. A folder is one of these by its name and by a lock file in it; whether its owner lives
/// is told by a lock on that file, which the system takes back at a process's end. A folder gets
/// its name only when it is locked, so that no moment of an owner that lives looks like an orphan.
/// What is killed before that leaves an empty folder of another name, which is removed after an
/// hour. Where the file system has no locks, only empty folders are cleaned up after the killed.
class ScratchFolder {
 public:
  /// What the names of these folders begin with; six letters and digits follow.
  static constexpr const char* name_begin = ".sonoglide-";

  /// @param parent  exists
  /// @throws ScratchError
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Descriptor lock_;
  std::optional<Undo> undo_;  ///< from the constructor on
};

}  // namespace sonoglide::process
