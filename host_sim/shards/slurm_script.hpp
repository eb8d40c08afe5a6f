/// A job script for Slurm's sbatch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sonoglide::shards {

/// Runs a command for each shard, as a task of a job array; a task whose node fails is queued again.
/// What a task says is in `slurm_K.log` in the folder.
/// @param command  its words, without --threads and --shard
/// @param folder   absolute
std::string slurm_script(const std::vector<std::string>& command, std::uint64_t shards,
                         const std::filesystem::path& folder);

/// Any text as one word of a shell, in quotes where it needs them.
std::string shell_word(const std::string& text);

}  // namespace sonoglide::shards
