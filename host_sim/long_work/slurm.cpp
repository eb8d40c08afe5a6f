#include "host_sim/long_work/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace sonoglide::long_work {

std::string slurm_script(const std::vector<std::string>& command, std::uint64_t shards,
                         const std::filesystem::path& folder) {
  std::string words;
  for (const std::string& word : command) {
    words += shell_word(word) + " \\\n  ";
  }
  // The folder's name may be one that Slurm would read its own patterns in: the shell opens the log.
  return fmt::format(
      R"(#!/bin/bash
#SBATCH --job-name=sonoglide
#SBATCH --array=1-{0}
#SBATCH --cpus-per-task=1
#SBATCH --output=/dev/null
#SBATCH --requeue
# Written by sonoglide. Partition, time and cores are to be set here or as options of sbatch.
exec >>{1}"/slurm_$SLURM_ARRAY_TASK_ID.log" 2>&1
exec {2}--threads "${{SLURM_CPUS_PER_TASK:-1}}" --shard "$SLURM_ARRAY_TASK_ID/{0}"
)",
      shards, shell_word(folder.string()), words);
}

std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("/._-=:,+").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) {
    return text;
  }
  std::string word = "'";
  for (const char each : text) {
    word += each == '\'' ? std::string(R"('\'')") : std::string(1, each);
  }
  return word + '\'';
}

std::string array_text(const std::vector<std::uint64_t>& numbers) {
  std::string text = "--array=";
  for (std::size_t begin = 0; begin < numbers.size();) {
    std::size_t end = begin + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) {
      ++end;
    }
    text += fmt::format("{}{}", begin == 0 ? "" : ",", numbers[begin]);
    if (end - begin > 1) {
      text += fmt::format("-{}", numbers[end - 1]);
    }
    begin = end;
  }
  return text;
}

}  // namespace sonoglide::long_work
