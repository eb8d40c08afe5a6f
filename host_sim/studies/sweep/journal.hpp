/// The finished points of a sweep on disk, so that one that was killed can go on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

/// What decides every row of a sweep: a journal serves no other.
struct Identity {
  std::string program;  ///< name, version and whatever else decides the last bit
  std::string scene;    ///< of the first point, in full
  std::string vary;     ///< the axes

  bool operator==(const Identity& other) const {
    return program == other.program && scene == other.scene && vary == other.vary;
  }
};

/// The journal in the folder is that of another sweep.
class ForeignJournal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Appends finished points to a file. The first line is the identity, every further one a record;
/// each carries its own checksum. A kill can tear the last record only, which is dropped, and all
/// that follows a damaged one. Points already handed to append() survive a kill of the program;
/// those more than about a second old survive a power failure.
class Journal {
 public:
  /// Opens the journal of this folder, or begins one; nobody else can until this is destroyed.
  /// @param folder  exists
  /// @param points  records of points from here on count as damaged
  /// @throws ForeignJournal, output::OutputError
  Journal(const std::filesystem::path& folder, const Identity& identity, std::size_t points);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// What was found on opening, in no particular order.
  const std::vector<Record>& finished() const { return finished_; }

  /// Finished points as append() takes them.
  static std::string text_of(const std::vector<Record>& records);

  /// @param text  from text_of()
  /// @throws output::OutputError
  void append(const std::string& text);

  /// The sweep is whole: removes the file.
  void remove();

 private:
  void lock();
  void recover(const Identity& identity, std::size_t points);
  void write(const std::string& text);
  void sync_now_and_then();
  [[noreturn]] void fail(const std::string& reason) const;
  [[noreturn]] void refuse(const std::string& contents) const;

  std::filesystem::path path_;
  int file_;
  double last_sync_s_;
  std::vector<Record> finished_;
};

}  // namespace sonoglide::sweep
