/// What Slurm's sbatch takes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sonoglide::long_work {

/// Runs a command for each shard, as a task of a job array; a task whose node fails is queued again.
/// What a task says is in `slurm_K.log` in the folder.
/// @param command  its words, without --threads and --shard
/// @param folder   absolute
std::string slurm_script(const std::vector<std::string>& command, std::uint64_t shards,
                         const std::filesystem::path& folder);

/// Any text as one word of a shell, in quotes where it needs them.
std::string shell_word(const std::string& text);

/// Of shards: `--array=3,7-9`. @param numbers  rising, one at least
std::string array_text(const std::vector<std::uint64_t>& numbers);

}  // namespace sonoglide::long_work
