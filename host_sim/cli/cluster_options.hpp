/// The options by which several machines divide a command among themselves.
#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host_sim/scene_file/source.hpp"
#include "host_sim/shards/collection.hpp"
#include "host_sim/shards/run_shard.hpp"
#include "host_sim/shards/shard.hpp"

namespace sonoglide::cli {

/// What shards and journals know a program by.
inline constexpr const char* program_version = "sonoglide " SONOGLIDE_VERSION;

/// At most one is given.
struct ClusterOptions {
  std::string shard;
  std::string merge;
  std::string status;
  std::uint64_t slurm = 0;  ///< shards

  /// Whether the folder of the shards is all that the command needs.
  bool of_a_folder() const { return !merge.empty() || !status.empty(); }
};

/// Adds --shard, --merge, --status and --slurm. The scene, and the other options that say what is
/// computed, go with none of --merge and --status.
void add_cluster_options(CLI::App& command, ClusterOptions& options,
                         const std::vector<std::string>& of_the_work);

/// @throws CLI::RequiredError  the command needs the option, and it was not given
void require(const CLI::App& command, const std::string& option);

/// Calls; what shards that do not belong together throw becomes an error of the option.
/// @throws CLI::ValidationError
template <class Call>
auto with_usable_shards(const char* option, const Call& call) {
  try {
    return call();
  } catch (const shards::UnusableShards& error) {
    throw CLI::ValidationError(option, error.what());
  }
}

/// Calls what merges; the shards that are missing are printed to standard output, for scripts.
/// @throws CLI::ValidationError, shards::Incomplete
template <class Call>
auto merged(const Call& call) {
  try {
    return with_usable_shards("--merge", call);
  } catch (const shards::Incomplete& error) {
    fmt::print("{}\n", shards::array_text(error.missing()));
    throw;
  }
}

/// A path as messages show it.
std::string shown(const std::filesystem::path& path);

/// Of one shard that was computed, or was there. @param rows  its file
std::string shard_text(const shards::ShardSummary& summary, const std::filesystem::path& rows);

/// What the tasks of a job array run.
struct Job {
  std::string command;  ///< `sweep`
  const scene_file::Source& source;
  const std::vector<std::string>& overrides;
  std::vector<std::string> options;  ///< words besides
  std::uint64_t shards;
};

/// Writes `COMMAND.slurm` to the folder, and a copy of the scene, which no later edit reaches.
/// @return what to tell
/// @throws output::OutputError
std::string write_job(const Job& job, const std::filesystem::path& out);

/// How far the shards in a folder are, with every one that is begun and all that are missing.
std::string status_text(const std::filesystem::path& folder);

}  // namespace sonoglide::cli
