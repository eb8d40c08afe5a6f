/// Keeps other runs of this program out of an output folder.
#pragma once

#include <filesystem>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::output {

/// A lock on the list of a folder (see WrittenFiles): who moves files there holds it alone, who
/// compares files with the list shares it, and waits for the other. Where the file system has no
/// locks, nobody waits.
class ListLock {
 public:
  enum class Kind { shared, alone };

  /// Of a folder without a list nobody shares one; alone, one begins it.
  ListLock(const std::filesystem::path& folder, Kind kind);
  /// A list that was begun and not replaced goes again.
  ~ListLock();
  ListLock(const ListLock&) = delete;
  ListLock& operator=(const ListLock&) = delete;

  /// Whether the folder had no list.
  bool began() const { return began_; }

  /// Takes a lock on the list that will replace this one, too: who comes then waits for that.
  void hold_next(const std::filesystem::path& list);

 private:
  std::filesystem::path list_;
  bool began_ = false;
  process::Descriptor file_;
  process::Descriptor next_;
};

}  // namespace sonoglide::output
