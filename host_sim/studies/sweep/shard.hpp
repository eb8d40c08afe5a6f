/// A share of a sweep, computed by itself.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/long_work/pace.hpp"
#include "host_sim/shards/run_shard.hpp"
#include "host_sim/studies/sweep/plan.hpp"

namespace sonoglide::sweep {

/// As shards::run_shard() with the points of a sweep.
/// @param program  name and version
/// @throws scene_file::SceneError  nothing was written
/// @throws long_work::ForeignJournal, output::OutputError
shards::ShardSummary run_shard(const Plan& plan, const shards::Shard& shard,
                               const std::filesystem::path& folder, const std::string& program,
                               unsigned threads, const long_work::Progress& progress);

}  // namespace sonoglide::sweep
