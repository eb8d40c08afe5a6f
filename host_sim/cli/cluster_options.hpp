/// The options by which several machines divide a command among themselves.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host_sim/shards/collection.hpp"
#include "host_sim/shards/shard.hpp"

namespace sonoglide::cli {

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

/// How far the shards in a folder are, with every one that is begun and all that are missing.
std::string status_text(const std::filesystem::path& folder);

}  // namespace sonoglide::cli
