/// What shards are shards of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/long_work/shard.hpp"

namespace sonoglide::long_work {

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
