/// A finished shard as a file: a header, a record for each point in their order, and an end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "host_sim/long_work/work.hpp"
#include "host_sim/process/checksum.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::long_work {

/// The file is not what its shard was published as; the message says in what, without the path.
class DamagedRows : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The file does not begin as a shard does: it may be anybody's.
class NoRows : public DamagedRows {
 public:
  using DamagedRows::DamagedRows;
};

/// Reads such a file from its beginning to its end, a record at a time.
class RowsReader {
 public:
  /// @throws NoRows  it cannot be read, or does not begin with a header
  explicit RowsReader(const std::filesystem::path& file);

  const ShardHeader& header() const { return header_; }
  PointRange range() const { return header_.shard().range(header_.work.points); }

  /// @return false at the end, which stands where it should and has the checksum of all before it
  /// @throws DamagedRows
  bool next(std::string& record);

 private:
  std::ifstream stream_;
  process::Checksum sum_;
  std::string line_;
  ShardHeader header_;
  std::uint64_t records_ = 0;
};

/// Writes such a file under a name of its own, and publishes it by renaming: it is there whole or
/// not at all.
class RowsWriter {
 public:
  /// @param copy  names the copy of the shard: no two that live have the same
  /// @throws process::FileError
  RowsWriter(const std::filesystem::path& folder, const ShardHeader& header,
             const std::string& copy);
  ~RowsWriter();
  RowsWriter(const RowsWriter&) = delete;
  RowsWriter& operator=(const RowsWriter&) = delete;

  /// The next record. @throws process::FileError
  void add(const std::string& record);

  /// All are there: the file is complete, on the disk and under its name.
  /// @throws process::FileError
  void publish();

 private:
  void put(const std::string& text);
  void flush();

  std::filesystem::path target_;
  std::filesystem::path staged_;
  process::Descriptor file_;
  process::Checksum sum_;
  std::string buffer_;
  std::uint64_t records_ = 0;
  bool published_ = false;
};

}  // namespace sonoglide::long_work
