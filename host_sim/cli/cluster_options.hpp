/// The options by which several machines divide a command among themselves.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/long_work/journal.hpp"
#include "host_sim/long_work/run_shard.hpp"
#include "host_sim/long_work/work.hpp"
#include "host_sim/scene_file/source.hpp"

namespace sonoglide::cli {

/// What shards and journals know a program by.
inline constexpr const char* program_version = "sonoglide " SONOGLIDE_VERSION;

/// At most one is given.
struct ClusterOptions {
  std::string shard;
  std::string merge;
  std::string status;
  std::uint64_t slurm = 0;  ///< shards
};

/// What a command does that several machines can divide among themselves; each gives what to print.
struct Divisible {
  std::function<std::string()> whole;
  std::function<std::string()> shard;
  std::function<std::string()> merge;
  std::function<std::string()> job;
};

/// Does what the options ask for. What is computed needs these options of the command besides.
/// @throws CLI::RequiredError  one of them was not given
void run_divisible(const CLI::App& command, const ClusterOptions& options,
                   const std::vector<std::string>& needed, const Divisible& divisible, bool quiet);

/// Adds --shard, --merge, --status and --slurm. The scene, and the other options that say what is
/// computed, go with none of --merge and --status.
void add_cluster_options(CLI::App& command, ClusterOptions& options,
                         const std::vector<std::string>& of_the_work);

/// Calls with a progress bar; the journal or shard of other work is an error of --out.
/// @throws CLI::ValidationError
template <class Call>
auto computed(bool quiet, const Call& call) {
  try {
    return with_bar(quiet, call);
  } catch (const long_work::ForeignJournal& error) {
    throw CLI::ValidationError("--out", error.what());
  }
}

/// Where what is merged goes: to the folder of --out, else to that of the shards.
std::filesystem::path merged_folder(const ClusterOptions& options, const std::string& out);

/// A path as messages show it.
std::string printable(const std::filesystem::path& path);

/// Of one shard that was computed, or was there. @param rows  its file
std::string shard_text(const long_work::ShardSummary& summary, const std::filesystem::path& rows);

/// What the tasks of a job array run.
struct Job {
  std::string command;  ///< `sweep`
  const scene_file::Source& source;
  const std::vector<std::string>& overrides;
  std::vector<std::string> options;  ///< words besides
  std::uint64_t points;
  std::uint64_t shards;
};

/// Writes `COMMAND.slurm` to the folder, and a copy of the scene, which no later edit reaches.
/// @return what to tell
/// @throws CLI::ValidationError  more shards than points
/// @throws process::FileError
std::string write_job(const Job& job, const std::filesystem::path& out);

}  // namespace sonoglide::cli
