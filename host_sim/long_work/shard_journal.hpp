/// The journals of a shard: each copy of it writes one of its own, and goes on from those of the
/// others.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/long_work/journal.hpp"
#include "host_sim/long_work/work.hpp"

namespace sonoglide::long_work {

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
  /// @throws ForeignJournal, output::OutputError
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

}  // namespace sonoglide::long_work
