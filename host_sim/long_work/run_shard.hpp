/// One shard of long work, from its journals to its file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "host_sim/long_work/kept_points.hpp"
#include "host_sim/long_work/pace.hpp"
#include "host_sim/long_work/work.hpp"

namespace sonoglide::long_work {

struct ShardSummary {
  PointRange points;
  bool was_there = false;            ///< published by an earlier or another copy
  std::uint64_t failed = 0;          ///< points that could not be computed
  std::uint64_t found_finished = 0;  ///< by an earlier copy that did not end
  double wall_s = 0.0;
};

/// Throws where one of these points is unusable; tells the pace, a stage of which this is.
using CheckPoints = std::function<void(const PointRange& points, Pace& pace)>;

/// Checks the shard's own points, computes those that no journal of the shard holds yet, in blocks,
/// and publishes them as `shard_K_of_N.rows`. The file is the same to the bit on any machine, for
/// any number of threads and copies and after any interruption. Where it is there already, nothing
/// is computed; where that one is damaged, it is replaced.
///
/// @throws what check throws; nothing was written
/// @throws ForeignJournal  the folder holds a shard of other work
/// @throws output::OutputError
ShardSummary run_shard(const ShardHeader& header, const CheckPoints& check,
                       const Computation& computation, const std::filesystem::path& folder,
                       const Progress& progress);

}  // namespace sonoglide::long_work
