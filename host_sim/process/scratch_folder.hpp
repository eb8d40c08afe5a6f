/// A folder for the files of a tool while it is at work.
#pragma once

#include <filesystem>

namespace sonoglide::process {

/// A folder of its own in another one, gone with its owner and all that is left in it.
class ScratchFolder {
 public:
  /// @param parent  exists
  /// @throws ProcessError  it cannot be created
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace sonoglide::process
