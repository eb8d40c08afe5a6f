/// A whole robustness study: from a task to files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "host_sim/long_work/collection.hpp"
#include "host_sim/long_work/journal.hpp"
#include "host_sim/long_work/pace.hpp"
#include "host_sim/long_work/run_shard.hpp"
#include "host_sim/studies/robust/study.hpp"
#include "host_sim/studies/robust/task.hpp"

namespace sonoglide::robust {

struct Outcome {
  Study study;
  std::size_t found_finished = 0;  ///< runs of an earlier, interrupted study
  double wall_s = 0.0;             ///< to compute those that were left
};

/// Checks every sample's plant, computes what the journal in the folder does not hold yet, and
/// writes robust.csv, search.csv, robust.json, worst.toml and report.html, all or none; the journal
/// goes last. The files of an interrupted study that is run again are those of one that was not.
///
/// @param program  name and version: a journal of another program is refused
/// @param threads  0: one for each core
/// @throws scene_file::SceneError  nothing was written
/// @throws long_work::ForeignJournal, process::FileError
Outcome run_robust(const Task& task, const std::filesystem::path& out, const std::string& program,
                   unsigned threads, const long_work::Progress& progress);

/// A share of the samples, as long_work::run_shard().
/// @throws scene_file::SceneError  nothing was written
/// @throws long_work::ForeignJournal, process::FileError
long_work::ShardSummary run_shard(const Task& task, const long_work::Shard& shard,
                                  const std::filesystem::path& folder, const std::string& program,
                                  unsigned threads, const long_work::Progress& progress);

/// What the shards in a folder are shards of.
/// @throws long_work::UnusableShards  of several works or of another program
Task task_of(const long_work::Collection& shards, const std::string& program);

/// Writes of these samples what run_robust() writes, to the bit. The search for the worst plant,
/// which needs all samples, is computed here, with a journal in the folder `out`.
/// @throws long_work::Incomplete  shards are missing or damaged; nothing was written
/// @throws long_work::ForeignJournal, process::FileError
Outcome merge_shards(const long_work::Collection& shards, const Task& task,
                     const std::filesystem::path& out, const std::string& program, unsigned threads,
                     const long_work::Progress& progress);

}  // namespace sonoglide::robust
