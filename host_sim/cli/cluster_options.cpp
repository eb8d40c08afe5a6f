#include "host_sim/cli/cluster_options.hpp"

#include <fmt/format.h>

#include "host_sim/cli/options.hpp"
#include "host_sim/long_work/collection.hpp"
#include "host_sim/long_work/slurm.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::cli {
namespace {

CLI::Option* add_folder(CLI::App& command, const char* name, std::string& folder,
                        const char* meaning) {
  return command.add_option(name, folder, meaning)->type_name("DIR")->check(not_empty("a folder"));
}

/// Calls; what shards that do not belong together throw becomes an error of the option.
/// @throws CLI::ValidationError
std::string with_usable_shards(const char* option, const std::function<std::string()>& call) {
  try {
    return call();
  } catch (const long_work::UnusableShards& error) {
    throw CLI::ValidationError(option, error.what());
  }
}

/// Calls what merges; the shards that are missing are printed to standard output, for scripts.
/// @throws CLI::ValidationError, long_work::Incomplete
std::string merged(const std::function<std::string()>& call) {
  try {
    return with_usable_shards("--merge", call);
  } catch (const long_work::Incomplete& error) {
    fmt::print("{}\n", long_work::array_text(error.missing()));
    throw;
  }
}

/// How far the shards in a folder are, with every one that is begun and all that are missing.
/// @param kind  of the command
std::string status_text(const std::filesystem::path& folder, const std::string& kind) try {
  const long_work::Collection found(folder);
  found.require_kind(kind);
  const std::vector<std::uint64_t> missing = found.missing();
  const std::vector<long_work::BegunShard> begun = found.begun();
  std::uint64_t points = found.points_there();
  std::string lines;
  for (const long_work::BegunShard& shard : begun) {
    points += shard.finished;
    lines += fmt::format("shard {}: {} of {} points, the last {:.0f} s ago\n", shard.number,
                         shard.finished, shard.points, shard.idle_s);
  }
  const std::uint64_t all = found.work().points;
  const std::uint64_t count = found.work().shards;
  std::string text = fmt::format("{} of {} shards are there, {} begun; {} of {} points, {:.1f} %\n",
                                 count - missing.size(), count, begun.size(), points, all,
                                 100.0 * static_cast<double>(points) / static_cast<double>(all));
  text += lines;
  return missing.empty() ? text
                         : text + fmt::format("missing: {}\n", long_work::array_text(missing));
} catch (const long_work::NoShards&) {
  return "no shard is begun\n";
}

/// @throws CLI::RequiredError  the command needs one of the options, and it was not given
void require(const CLI::App& command, const std::vector<std::string>& needed) {
  for (const std::string& option : needed) {
    if (command.get_option(option)->empty()) {
      throw CLI::RequiredError(option);
    }
  }
}

std::string computed_part(const ClusterOptions& options, const Divisible& divisible) {
  if (!options.shard.empty()) {
    return divisible.shard();
  }
  return options.slurm > 0 ? divisible.job() : divisible.whole();
}

}  // namespace

void run_divisible(const CLI::App& command, const ClusterOptions& options,
                   const std::vector<std::string>& needed, const Divisible& divisible, bool quiet) {
  if (!options.status.empty()) {
    fmt::print("{}", with_usable_shards("--status", [&] {
                 return status_text(options.status, command.get_name());
               }));
    return;
  }
  if (options.merge.empty()) {
    require(command, needed);
  }
  const std::string text =
      options.merge.empty() ? computed_part(options, divisible) : merged(divisible.merge);
  if (!quiet) {
    fmt::print("{}", text);
  }
}

std::filesystem::path merged_folder(const ClusterOptions& options, const std::string& out) {
  return out.empty() ? options.merge : out;
}

void add_cluster_options(CLI::App& command, ClusterOptions& options,
                         const std::vector<std::string>& of_the_work) {
  CLI::Option* shard = command
                           .add_option("--shard", options.shard,
                                       "Compute the K-th of N shares alone and leave it as "
                                       "shard_K_of_N.rows in the folder of --out")
                           ->type_name("K/N")
                           ->check([](const std::string& text) {
                             return long_work::parse_shard(text)
                                        ? std::string()
                                        : fmt::format(
                                              "\"{}\"; allowed: K/N, N from 1 to {}, K "
                                              "from 1 to N",
                                              text, long_work::most_shards);
                           });
  CLI::Option* merge = add_folder(command, "--merge", options.merge,
                                  "Make one of the shards in this folder; those that are missing "
                                  "are printed as sbatch takes them: --array=3,7-9");
  CLI::Option* status = add_folder(command, "--status", options.status,
                                   "Print how far the shards in this folder are");
  CLI::Option* slurm =
      command
          .add_option("--slurm", options.slurm,
                      "Write a job script for a Slurm array of N shards, and a copy of the scene, "
                      "to the folder of --out; nothing is computed")
          ->type_name("N")
          ->check(
              [](const std::string& text) { return check_whole(text, 1, long_work::most_shards); });
  const std::vector<CLI::Option*> all = {shard, merge, status, slurm};
  for (CLI::Option* one : all) {
    for (CLI::Option* other : all) {
      if (one != other) {
        one->excludes(other);
      }
    }
  }
  slurm->excludes(command.get_option("--threads"));  // the script takes the task's cores
  for (const std::string& name : of_the_work) {
    merge->excludes(command.get_option(name));
    status->excludes(command.get_option(name));
  }
}

std::string printable(const std::filesystem::path& path) {
  return process::printable(path.string());
}

std::string shard_text(const long_work::ShardSummary& summary, const std::filesystem::path& rows) {
  if (summary.was_there) {
    return fmt::format("{}: is there\n", printable(rows));
  }
  std::string lines = fmt::format("{} points", summary.points.size());
  if (summary.found_finished > 0) {
    lines += fmt::format(", {} of them finished before", summary.found_finished);
  }
  lines += fmt::format("; {:.3g} s\n", summary.wall_s);
  if (summary.failed > 0) {
    lines += fmt::format("{} points failed\n", summary.failed);
  }
  return lines + fmt::format("rows: {}\n", printable(rows));
}

std::string write_job(const Job& job, const std::filesystem::path& out) {
  namespace fs = std::filesystem;
  if (job.shards > job.points) {
    throw CLI::ValidationError("--slurm", fmt::format("{} shards of {} points; allowed: 1 to {}",
                                                      job.shards, job.points, job.points));
  }
  const fs::path folder = fs::weakly_canonical(fs::absolute(out));
  const std::string scene = output_folder("", job.source.name(), ".toml").filename().string();
  const std::string script = job.command + ".slurm";
  std::vector<std::string> command = {fs::read_symlink("/proc/self/exe").string(), job.command,
                                      (folder / scene).string()};
  for (const std::string& each : job.overrides) {
    command.insert(command.end(), {"--set", each});
  }
  command.insert(command.end(), job.options.begin(), job.options.end());
  command.insert(command.end(), {"--out", folder.string(), "--quiet"});
  process::OutputFolder files(folder);
  files.write(scene, job.source.text);
  files.write(script, long_work::slurm_script(command, job.shards, folder));
  files.commit();
  return fmt::format("job script: {}\n", printable(folder / script));
}

}  // namespace sonoglide::cli
