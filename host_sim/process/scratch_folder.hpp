/// A folder for files that are not there to stay.
#pragma once

#include <filesystem>

#include <string>

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

/// A hidden folder of its own in another one, gone with its owner and all that is left in it.
///
/// A process that is killed leaves its folder behind: the next ScratchFolder in the same parent
/// removes it. Which of them has an owner that lives is told by a lock on the folder, which the
/// system takes back at a process's end; that a folder is one of these, by its name and a mark in
/// it. Where the file system has no locks, nothing is cleaned up after the killed.
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
};

}  // namespace sonoglide::process
