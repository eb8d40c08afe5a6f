/// A sweep from options to files: whole, a shard of it, and its shards made one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "host_sim/long_work/pace.hpp"
#include "host_sim/long_work/run_shard.hpp"
#include "host_sim/studies/sweep/plan.hpp"

namespace sonoglide::sweep {

inline constexpr const char* table_file = "sweep.csv";
inline constexpr const char* page_file = "report.html";
inline constexpr const char* picture_file = "sweep.svg";

struct Summary {
  std::size_t points;
  std::size_t failed;
  std::size_t found_finished;      ///< by an earlier, interrupted sweep
  double wall_s;                   ///< to read all points and compute those that were left
  std::vector<std::string> notes;  ///< start_notes()
};

/// Checks every point's scene, computes the points that the journal in the folder does not hold
/// yet, and writes sweep.csv, sweep.svg (one or two drawn axes) and report.html, all or none; the
/// journal goes last. The files of an interrupted sweep that is run again are those of one that was
/// not.
///
/// @param program  name and version: a journal of another program is refused
/// @param threads  0: one for each core
/// @throws scene_file::SceneError  nothing was written
/// @throws long_work::ForeignJournal, process::FileError, process::ProcessError
Summary run_sweep(const Plan& plan, const std::filesystem::path& out, const std::string& program,
                  unsigned threads, const long_work::Progress& progress);

/// As long_work::run_shard() with the points of a sweep.
/// @param program  name and version
/// @throws scene_file::SceneError  nothing was written
/// @throws long_work::ForeignJournal, process::FileError
long_work::ShardSummary run_shard(const Plan& plan, const long_work::Shard& shard,
                                  const std::filesystem::path& folder, const std::string& program,
                                  unsigned threads, const long_work::Progress& progress);

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
/// @throws long_work::Incomplete  shards are missing or damaged; nothing was written
/// @throws long_work::UnusableShards  of several works or of another program; nothing was written
/// @throws process::FileError, process::ProcessError
MergeSummary merge_shards(const std::filesystem::path& folder, const std::filesystem::path& out,
                          const std::string& program, const long_work::Progress& progress);

}  // namespace sonoglide::sweep
