/// A robustness study computed: every sample, and the search for the worst plant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/long_work/journal.hpp"
#include "host_sim/long_work/kept_points.hpp"
#include "host_sim/long_work/pace.hpp"
#include "host_sim/long_work/record.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/robust/task.hpp"

namespace sonoglide::robust {

// A plant of a robustness study as a row of its table, and as a line of its journal.

/// How the loop did on one plant: of each figure the worst of its target steps. A figure that is not
/// defined is NaN.
struct PlantRow {
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

  std::string status = "ok";           ///< or why the loop could not be computed, one line
  double settling_time_s = undefined;  ///< NaN also where a step never settles
  double overshoot = undefined;
  double steady_error = undefined;  ///< magnitude
  double ripple = undefined;
  double deviation = undefined;  ///< |steady error| + ripple of one step
  std::uint64_t unsettled = 0;   ///< steps that never settle
  std::uint64_t limits = 0;      ///< bit n: control::Limit n is named of a step
  std::uint64_t faults = 0;      ///< bit n: control::Fault n has come
  std::uint64_t trace_hash = 0;  ///< of every drive command

  static constexpr auto kept =
      std::tuple(&PlantRow::settling_time_s, &PlantRow::overshoot, &PlantRow::steady_error,
                 &PlantRow::ripple, &PlantRow::deviation, &PlantRow::unsettled, &PlantRow::limits,
                 &PlantRow::faults, &PlantRow::trace_hash);
  bool plausible() const;

  bool ok() const { return status == "ok"; }
  /// Something has switched the drive off, a step never settles, or the loop could not be computed.
  bool failed() const { return !ok() || faults != 0 || unsettled != 0; }
  /// Grows with the deviation; of a failed plant it is above that of every other, of one that could
  /// not be computed highest.
  double badness() const;
};

PlantRow row_of(const std::vector<report::StepMetrics>& steps, const loop::ControlRecord& control);

/// A loop that could not be computed.
PlantRow failed_row(const std::string& reason);

std::vector<std::string> limit_names(const PlantRow& row);
std::vector<std::string> fault_names(const PlantRow& row);

/// Samples first, then the runs of the search.
using Record = long_work::Record<PlantRow>;

// The largest value of a function over a cube, without its derivatives.

/// A place in the cube [0, 1]^n.
using Place = std::vector<double>;

/// Called with the places one after the other, `run` counting them from 0.
using Function = std::function<double(std::size_t run, const Place& place)>;

/// Climbs from a place to a higher one: COBYLA (Powell 1994) of NLopt, which models the function as
/// linear in a region that shrinks. Deterministic. The last run moves what is within 1e-3 of a face
/// of the cube onto it: a corner is met to the bit. Inside the cube a smooth maximum is met to about
/// 1e-3 of its edges.
/// @param runs  at most, > 0
void climb(const Place& start, std::size_t runs, const Function& function);

// Many plants under one controller.

/// Takes rows, by the places of their plants, from any thread.
using TakeRows = std::function<void(std::vector<Record> rows)>;

/// Runs each of the plants with a controller of this design, on all threads: those that suit SIMD
/// lanes in them, the others, and what the lanes give up, as `run` does. A row depends on its plant
/// alone, to the bit; a computation that fails gives a row that says why.
/// @param plants  closed-loop scenes for which the design was made: they differ in true values alone
void run_plants(const std::vector<scene::Scene>& plants, const configure::ControlDesign& design,
                const TakeRows& take);
std::vector<PlantRow> run_plants(const std::vector<scene::Scene>& plants,
                                 const configure::ControlDesign& design);

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
void check_samples(const Task& task, const long_work::PointRange& samples);

/// The samples as long work. @param task  outlives it
long_work::Computation computation_of(const Task& task);

/// The rows that the journal holds and, into it, the others: the same to the bit for any number of
/// threads and after any interruption.
/// @throws process::FileError  the journal cannot be written
class Solver {
 public:
  /// Opens or begins the journal of the folder, which exists.
  /// @param program  name, version and whatever else decides the last bit
  /// @param samples  those of shards; empty: they are computed here
  /// @throws long_work::ForeignJournal, process::FileError
  Solver(const Task& task, const std::filesystem::path& folder, const std::string& program,
         std::vector<PlantRow> samples = {});

  std::size_t found_finished() const;

  Study solve(const long_work::Progress& progress);

  /// The study is on disk: the journal goes.
  void remove_journal() { journal_.remove(); }

 private:
  bool take(std::string_view record);
  void complete_samples(long_work::Pace& pace);
  std::vector<SearchRun> search(long_work::Pace& pace);
  std::vector<SearchRun> climb_from(std::size_t sample, std::size_t ordinal, std::size_t runs,
                                    long_work::Pace& pace);
  PlantRow run(std::size_t place, const Factors& factors);

  const Task& task_;
  std::vector<PlantRow> samples_;             ///< all, or none yet
  long_work::KeptPoints kept_;                ///< samples in the journal
  std::map<std::size_t, PlantRow> searched_;  ///< found in the journal, by their places
  long_work::Journal journal_;
};

}  // namespace sonoglide::robust
