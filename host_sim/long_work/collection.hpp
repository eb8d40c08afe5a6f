/// The shards in a folder, as one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host_sim/long_work/record.hpp"
#include "host_sim/long_work/work.hpp"

namespace sonoglide::long_work {

/// The folder holds no shards, or such as do not belong together; the message names two of them.
class UnusableShards : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The folder holds no shards, not even one that is begun.
class NoShards : public UnusableShards {
 public:
  using UnusableShards::UnusableShards;
};

/// Shards are missing or damaged.
class Incomplete : public std::runtime_error {
 public:
  /// @param missing  numbers, rising
  Incomplete(const std::string& message, std::vector<std::uint64_t> missing)
      : std::runtime_error(message), missing_(std::move(missing)) {}

  const std::vector<std::uint64_t>& missing() const { return missing_; }

 private:
  std::vector<std::uint64_t> missing_;
};

/// A shard that is not there yet, but a copy of it has begun.
struct BegunShard {
  std::uint64_t number;
  std::uint64_t finished;  ///< points in the longest journal
  std::uint64_t points;
  double idle_s;  ///< since something was written to it
};

class Collection {
 public:
  /// Reads the names in the folder and the header of each shard, but no record.
  /// @throws UnusableShards, process::FileError
  explicit Collection(std::filesystem::path folder);

  const Work& work() const { return *work_; }

  /// @throws UnusableShards  the shards are of another kind
  void require_kind(const std::string& kind) const;

  /// @throws UnusableShards  the shards are of another kind, program or arithmetic
  void require_of(const std::string& kind, const std::string& program,
                  const std::string& arithmetic) const;

  /// Numbers of the shards that are not there, or whose header is damaged, rising.
  std::vector<std::uint64_t> missing() const;
  std::uint64_t points_there() const;
  /// In the order of their numbers.
  std::vector<BegunShard> begun() const;

  /// Reads every shard, in the order of the points, and checks it. Behind a damaged one the others
  /// are checked, and no longer taken.
  /// @throws Incomplete  shards are missing or damaged
  void for_each_record(const TakeRecord& take) const;

 private:
  void note(const std::filesystem::path& file, const ShardFileName& name);
  void compare(const std::filesystem::path& file, const Work& work);
  [[noreturn]] void fail(std::vector<std::uint64_t> missing) const;

  std::filesystem::path folder_;
  std::optional<Work> work_;                                 ///< from the constructor on
  std::filesystem::path work_file_;                          ///< that it was read from
  std::vector<bool> there_;                                  ///< by number less 1
  std::map<std::uint64_t, std::filesystem::path> journals_;  ///< the longest of each shard
  mutable std::vector<std::string> damages_;                 ///< a line each
};

}  // namespace sonoglide::long_work
