/// The shards of a sweep made one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "host_sim/long_work/pace.hpp"

namespace sonoglide::sweep {

struct MergeSummary {
  std::size_t points;
  std::size_t failed;
  bool drawn;  ///< false: more than most_points, sweep.csv alone is written
};

/// Checks the shards in the folder and writes of their rows what run_sweep() writes, to the bit:
/// sweep.csv, and, of at most most_points points, sweep.svg and report.html. More points are passed
/// on in memory that does not grow. The shards stay.
///
/// @param program  name and version: shards of another program are refused
/// @throws shards::Incomplete  shards are missing or damaged; nothing was written
/// @throws shards::UnusableShards  of several works or of another program; nothing was written
/// @throws output::OutputError, process::ProcessError
MergeSummary merge_shards(const std::filesystem::path& folder, const std::filesystem::path& out,
                          const std::string& program, const long_work::Progress& progress);

}  // namespace sonoglide::sweep
