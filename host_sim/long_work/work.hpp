/// What shards are shards of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sonoglide::long_work {

inline constexpr std::uint64_t most_shards = 1'000'000;

/// The points from `first` up to, without it, `end`.
struct PointRange {
  std::uint64_t first = 0;
  std::uint64_t end = 0;

  std::uint64_t size() const { return end - first; }
};

/// Number K of N.
struct Shard {
  std::uint64_t number = 1;  ///< 1 to count
  std::uint64_t count = 1;   ///< 1 to most_shards

  /// Those of so many points that are this shard's: the shards in their order are all of them, and
  /// no two differ by more than one point in size. @param points  at most 1e12
  PointRange range(std::uint64_t points) const;
};

/// `3/8`; absent for anything else.
std::optional<Shard> parse_shard(std::string_view text);

/// What a file in the folder of the shards is.
struct ShardFileName {
  enum class Kind { rows, journal };
  Shard shard;
  Kind kind = Kind::rows;
};

/// `shard_3_of_8.rows`: a finished shard.
std::string rows_name(const Shard& shard);

/// `shard_3_of_8.NODE.journal`: an unfinished one, by the copy that writes it.
std::string journal_name(const Shard& shard, const std::string& copy);

/// `.shard_3_of_8.rows.NODE`: a finished one that this copy is about to publish.
std::string staged_name(const Shard& shard, const std::string& copy);

/// The copy that writes a journal of the shard. @param name  from journal_name()
std::string copy_of(const Shard& shard, const std::string& name);

/// Absent for a file that is none of the first two.
std::optional<ShardFileName> parse_file_name(std::string_view name);

/// The same in every shard, and enough to merge them without the scene file.
struct Work {
  std::string kind;                    ///< `sweep`
  std::string program;                 ///< name and version
  std::string arithmetic;              ///< what else decides the last bit, by name
  std::string name;                    ///< of the scene
  std::string scene;                   ///< the text of its file
  std::vector<std::string> overrides;  ///< as `--set` takes them
  std::vector<std::string> options;    ///< what decides the work besides the scene
  std::uint64_t points = 0;
  std::uint64_t shards = 1;
};

struct ShardHeader {
  Work work;
  std::uint64_t number = 1;  ///< of the shard

  Shard shard() const { return {number, work.shards}; }
};

/// One line of JSON.
std::string header_text(const ShardHeader& header);

/// Absent if the text is no such line, or of another format.
std::optional<ShardHeader> parse_header(std::string_view text);

/// The first thing in which two works differ and what each has, to follow the name of its file:
/// `has lanes "a"` and `has lanes "b"`. Empty texts if they do not differ.
struct Difference {
  std::string of_one;
  std::string of_other;

  bool none() const { return of_one.empty(); }
};
Difference difference(const Work& one, const Work& other);

}  // namespace sonoglide::long_work
