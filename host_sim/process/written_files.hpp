/// Which files of a folder this program has written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {

// Keeps other runs of this program out of an output folder.

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
  Descriptor file_;
  Descriptor next_;
};

/// The list of them, kept in the folder itself, each with its size and checksum: a file that
/// somebody else has made or changed since is not on it. A file that is about to be replaced is on
/// it with its old content and its new one, so that the list is true at every moment of the move.
class WrittenFiles {
 public:
  /// The list's own name in the folder.
  static constexpr const char* file_name = ".sonoglide";

  /// The list of a folder, empty where it has none.
  /// @throws FileError  a file of that name is no such list
  explicit WrittenFiles(const std::filesystem::path& folder);

  /// Whether the file that stands there under this name is as this program has left it.
  bool has(const std::string& name) const;

  /// @param file  with the content that will stand in the folder under this name
  /// @throws FileError  it cannot be read
  void add(const std::string& name, const std::filesystem::path& file);

  /// As it is kept.
  std::string text() const;

 private:
  struct Content {
    std::uint64_t bytes;
    std::uint64_t checksum;

    bool operator==(const Content& other) const {
      return bytes == other.bytes && checksum == other.checksum;
    }
  };

  static Content content_of(const std::filesystem::path& file);

  std::filesystem::path folder_;
  std::map<std::string, std::vector<Content>> files_;
};

}  // namespace sonoglide::process
