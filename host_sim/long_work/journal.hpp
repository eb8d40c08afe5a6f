/// What a long computation has finished, on disk, so that one that was killed can go on.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/long_work/record.hpp"
#include "host_sim/process/file_error.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::long_work {

/// Whose journal it is, in the words of messages.
struct JournalKind {
  const char* work;     ///< `sweep`
  const char* options;  ///< `--vary`: what decides the work besides the scene
};

/// What decides every record: a journal serves no other work.
struct Identity {
  std::string program;  ///< name, version and whatever else decides the last bit
  std::string scene;    ///< in full
  std::string options;
};

/// The journal in the folder is that of other work.
class ForeignJournal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Somebody else has the journal open.
class JournalInUse : public process::FileError {
 public:
  using FileError::FileError;
};

/// Appends records to a file. The first line is the identity, every further one a record; each
/// carries its own checksum. A kill can tear the last record only, which is dropped, and all that
/// follows a damaged one. Records already handed to append() survive a kill of the program; those
/// more than about a second old survive a power failure.
class Journal {
 public:
  /// Takes a record that was found; false if it is none.
  using Take = std::function<bool(std::string_view record)>;

  /// Opens the journal, or begins it; nobody else can until this is destroyed.
  /// @param path     its folder exists
  /// @param take     called with each record that is there; what it does not take counts as damaged
  /// @param another  a journal of the same work, left as it is: what it holds, this one begins
  ///                 with, if that is more; empty: none
  /// @throws ForeignJournal, JournalInUse, process::FileError
  Journal(std::filesystem::path path, const JournalKind& kind, const Identity& identity,
          const Take& take, const std::filesystem::path& another = {});
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// What the first line of a journal says, without the end of the line; absent if it is none.
  static std::optional<Identity> identity_in(std::string_view first_line);

  /// From any thread. @throws process::FileError
  void append(const std::vector<FinishedPoint>& points);

  const std::filesystem::path& path() const { return path_; }

  /// The work is whole: removes the file.
  void remove();

 private:
  void open();
  void lock();
  void begin_with(const std::filesystem::path& another, const Identity& identity);
  void recover(const Identity& identity, const Take& take);
  std::string header_text(const Identity& identity) const;
  std::string difference(std::string_view header, const Identity& identity) const;
  void sync_now_and_then();
  void sync();
  [[noreturn]] void refuse(const std::filesystem::path& journal, const std::string& contents) const;

  JournalKind kind_;
  std::filesystem::path path_;
  process::Descriptor file_;
  std::mutex mutex_;
  double last_sync_s_;
};

}  // namespace sonoglide::long_work
