/// A robustness study computed: every sample, and the search for the worst plant.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/long_work/journal.hpp"
#include "host_sim/long_work/pace.hpp"
#include "host_sim/shards/shard.hpp"
#include "host_sim/studies/robust/row.hpp"
#include "host_sim/studies/robust/task.hpp"

namespace sonoglide::robust {

/// A run of the search.
struct SearchRun {
  std::size_t climb;  ///< which of the climbs, each from another sample
  Factors factors;
  PlantRow row;
};

struct WorstPlant {
  std::string found_by;  ///< `sample 17`, from 0; `search`
  Factors factors;
  PlantRow row;
};

struct Study {
  std::vector<PlantRow> samples;
  std::vector<SearchRun> search;  ///< in the order of the climbs
  WorstPlant worst;               ///< by PlantRow::badness(), the first of several

  std::size_t failures() const;
  std::size_t search_failures() const;
};

/// Reads these samples, so that an unusable one shows before anything is computed.
/// @throws scene_file::SceneError  the error of the first
void check_samples(const Task& task, const shards::PointRange& samples);

/// Takes samples that are computed, from any thread: so many of a list, from this one on.
using TakeRows = std::function<void(std::size_t first, const std::vector<PlantRow>& rows)>;

/// Runs samples on all threads, some hundreds of lanes at a time.
void run_samples(const Task& task, const std::vector<std::size_t>& samples, const TakeRows& take);

/// The rows that the journal holds and, into it, the others: the same to the bit for any number of
/// threads and after any interruption.
/// @throws output::OutputError  the journal cannot be written
class Solver {
 public:
  /// Opens or begins the journal of the folder, which exists.
  /// @param program  name, version and whatever else decides the last bit
  /// @param samples  that are known already, from the first on
  /// @throws long_work::ForeignJournal, output::OutputError
  Solver(const Task& task, const std::filesystem::path& folder, const std::string& program,
         const std::vector<PlantRow>& samples = {});

  std::size_t found_finished() const { return found_finished_; }

  Study solve(long_work::Pace& pace);

  /// The study is on disk: the journal goes.
  void remove_journal() { journal_.remove(); }

 private:
  bool take(std::string_view text);
  void hand_in(std::size_t place, const PlantRow& row);
  std::vector<PlantRow> all_samples(long_work::Pace& pace);
  std::vector<SearchRun> search(const std::vector<PlantRow>& samples, long_work::Pace& pace);
  std::vector<SearchRun> climb_from(std::size_t sample, std::size_t ordinal, std::size_t runs,
                                    long_work::Pace& pace);
  PlantRow run(std::size_t place, const Factors& factors);

  const Task& task_;
  std::mutex mutex_;
  std::map<std::size_t, PlantRow> known_;  ///< by the place of its record
  std::size_t found_finished_ = 0;
  long_work::Journal journal_;
};

}  // namespace sonoglide::robust
