/// One shard of long work, from its journals to its file.
#pragma once

#include <tbb/global_control.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/long_work/pace.hpp"
#include "host_sim/shards/work.hpp"

namespace sonoglide::shards {

/// While it lives, work is done on at most so many threads; 0: one for each core.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads);

 private:
  tbb::global_control limit_;
};

/// What a record says, to those who do not know what it is of.
struct RecordFacts {
  std::uint64_t point;
  bool failed;  ///< the point could not be computed
};

struct FinishedPoint {
  std::uint64_t point;
  std::string record;  ///< one line
};

/// Takes finished points, from any thread.
using Sink = std::function<void(const std::vector<FinishedPoint>& points)>;

/// How the points are computed. A record depends on its point alone, to the bit.
struct Computation {
  /// Throws where one of these points is unusable; tells the pace, a stage of which this is.
  std::function<void(const PointRange& points, long_work::Pace& pace)> check;
  /// Computes the open points of a block, on all threads.
  std::function<void(const PointRange& block, const std::vector<std::uint64_t>& open,
                     const Sink& sink)>
      compute;
  /// Absent for a text that is no record.
  std::function<std::optional<RecordFacts>(std::string_view record)> facts;
};

struct ShardSummary {
  PointRange points;
  bool was_there = false;            ///< published by an earlier or another copy
  std::uint64_t failed = 0;          ///< points that could not be computed
  std::uint64_t found_finished = 0;  ///< by an earlier copy that did not end
  double wall_s = 0.0;
};

/// Checks the shard's own points, computes those that no journal of the shard holds yet, in blocks,
/// and publishes them as `shard_K_of_N.rows`. The file is the same to the bit on any machine, for
/// any number of threads and copies and after any interruption. Where it is there already, nothing
/// is computed; where that one is damaged, it is replaced.
///
/// @param threads  0: one for each core
/// @throws what Computation::check throws; nothing was written
/// @throws long_work::ForeignJournal  the folder holds a shard of other work
/// @throws output::OutputError
ShardSummary run_shard(const ShardHeader& header, const Computation& computation,
                       const std::filesystem::path& folder, unsigned threads,
                       const long_work::Progress& progress);

}  // namespace sonoglide::shards
