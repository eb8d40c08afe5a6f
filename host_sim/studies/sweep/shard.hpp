/// A share of a sweep, computed by itself.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "host_sim/long_work/pace.hpp"
#include "host_sim/shards/shard.hpp"
#include "host_sim/shards/work.hpp"
#include "host_sim/studies/sweep/plan.hpp"

namespace sonoglide::sweep {

struct ShardSummary {
  PointRange points;
  bool was_there = false;          ///< published by an earlier or another copy
  std::size_t failed = 0;          ///< points that could not be computed
  std::size_t found_finished = 0;  ///< by an earlier copy that did not end
  double wall_s = 0.0;
};

/// What the shards of a sweep have in common.
shards::Work work_of(const Plan& plan, const std::string& program, std::uint64_t shards);

/// Checks the scenes of the shard's own points, computes those that no journal of the shard holds
/// yet, in blocks, and publishes them as `shard_K_of_N.rows`. The file is the same to the bit on
/// any machine, for any number of threads and copies and after any interruption. Where it is there
/// already, nothing is computed; where that one is damaged, it is replaced.
///
/// @param program  name and version
/// @param threads  0: one for each core
/// @throws scene_file::SceneError  nothing was written
/// @throws long_work::ForeignJournal  the folder holds a shard of other work
/// @throws output::OutputError
ShardSummary run_shard(const Plan& plan, const shards::Shard& shard,
                       const std::filesystem::path& folder, const std::string& program,
                       unsigned threads, const long_work::Progress& progress);

}  // namespace sonoglide::sweep
