/// One shard of long work, from its journals to its file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/long_work/journal.hpp"
#include "host_sim/long_work/kept_points.hpp"
#include "host_sim/long_work/pace.hpp"
#include "host_sim/long_work/work.hpp"

namespace sonoglide::long_work {

// The journals of a shard: each copy of it writes one of its own, and goes on from those of the
// others.

/// The files in the folder that are journals of this shard, by any copy, sorted.
std::vector<std::filesystem::path> journals_of(const std::filesystem::path& folder,
                                               const Shard& shard);

/// The header in a journal, absent where it holds none that is whole.
std::optional<ShardHeader> journal_header(const std::filesystem::path& journal);

/// A copy writes `shard_K_of_N.NODE.journal`, NODE being the name of its machine; where a copy that
/// lives has that one, `shard_K_of_N.NODE-2.journal` and so on. So no file has two writers, on file
/// systems whose locks do not reach from one machine to the other either. The longest of the other
/// journals is what a copy begins with.
class ShardJournal {
 public:
  /// @param folder  exists
  /// @param take    as of Journal
  /// @throws ForeignJournal, process::FileError
  ShardJournal(const std::filesystem::path& folder, const ShardHeader& header,
               const Journal::Take& take);

  Journal& file() { return *journal_; }
  /// Names this copy among those that live.
  const std::string& copy() const { return copy_; }

 private:
  std::string copy_;
  std::optional<Journal> journal_;  ///< from the constructor on
};

/// The shard is published: removes its journals and what a killed copy was about to publish, but for
/// those of other copies that live.
void remove_journals(const std::filesystem::path& folder, const Shard& shard);

struct ShardSummary {
  PointRange points;
  bool was_there = false;            ///< published by an earlier or another copy
  std::uint64_t failed = 0;          ///< points that could not be computed
  std::uint64_t found_finished = 0;  ///< by an earlier copy that did not end
  double wall_s = 0.0;
};

/// Throws where one of these points is unusable; tells the pace, a stage of which this is.
using CheckPoints = std::function<void(const PointRange& points, Pace& pace)>;

/// Checks the shard's own points, computes those that no journal of the shard holds yet, in blocks,
/// and publishes them as `shard_K_of_N.rows`. The file is the same to the bit on any machine, for
/// any number of threads and copies and after any interruption. Where it is there already, nothing
/// is computed; where that one is damaged, it is replaced.
///
/// @throws what check throws; nothing was written
/// @throws ForeignJournal  the folder holds a shard of other work
/// @throws process::FileError
ShardSummary run_shard(const ShardHeader& header, const CheckPoints& check,
                       const Computation& computation, const std::filesystem::path& folder,
                       const Progress& progress);

}  // namespace sonoglide::long_work
