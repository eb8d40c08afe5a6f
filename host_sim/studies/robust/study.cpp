#include "host_sim/studies/robust/study.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/to_json.hpp"
#include "host_sim/studies/robust/run_plants.hpp"
#include "host_sim/studies/robust/search.hpp"
#include "host_sim/studies/robust/spread.hpp"

namespace sonoglide::robust {
namespace {

constexpr long_work::JournalKind kind = {"study", "--samples, --search or --seed"};

long_work::Identity identity_of(const Task& task, const std::string& program) {
  const Counts& counts = task.counts();
  return {program, scene_file::to_json(task.nominal()).dump(),
          fmt::format("{} {} {}", counts.samples, counts.search, counts.seed)};
}

bool failed(const PlantRow& row) {
  return row.failed();
}

}  // namespace

std::size_t Study::failures() const {
  return static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), failed));
}

std::size_t Study::search_failures() const {
  return static_cast<std::size_t>(std::count_if(
      search.begin(), search.end(), [](const SearchRun& each) { return each.row.failed(); }));
}

void check_samples(const Task& task, const shards::PointRange& samples) {
  constexpr std::size_t samples_per_task = 256;
  std::atomic<std::size_t> lowest{samples.end};
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(samples.first, samples.end, samples_per_task),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < std::min(range.end(), lowest.load()); ++i) {
          try {
            task.plant(task.sample(i));
          } catch (const scene_file::SceneError&) {
            std::size_t seen = lowest.load();
            while (i < seen && !lowest.compare_exchange_weak(seen, i)) {
            }
          }
        }
      },
      tbb::simple_partitioner());
  if (lowest < samples.end) {
    task.plant(task.sample(lowest));
  }
}

void run_samples(const Task& task, const std::vector<std::size_t>& samples, const TakeRows& take) {
  // Keeps the lanes busy until few are left, and threads wait for no more.
  constexpr std::size_t samples_per_call = 128;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, samples.size(), samples_per_call),
      [&](const tbb::blocked_range<std::size_t>& range) {
        std::vector<scene::Scene> plants;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          plants.push_back(task.plant(task.sample(samples[i])));
        }
        take(range.begin(), run_plants(plants, task.design()));
      },
      tbb::simple_partitioner());
}

Solver::Solver(const Task& task, const std::filesystem::path& folder, const std::string& program,
               const std::vector<PlantRow>& samples)
    : task_(task),
      journal_(folder / "robust.journal", kind, identity_of(task, program),
               [this](std::string_view text) { return take(text); }) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    known_.insert_or_assign(i, samples[i]);
  }
  found_finished_ = known_.size();
}

bool Solver::take(std::string_view text) {
  std::optional<Record> record = parse_record(text);
  if (!record || record->place >= task_.counts().samples + task_.counts().search) {
    return false;
  }
  known_.insert_or_assign(record->place, std::move(record->row));
  return true;
}

void Solver::hand_in(std::size_t place, const PlantRow& row) {
  // The text is made before the lock: that is most of the work.
  const std::string line = long_work::Journal::line_of(record_text({place, row}));
  const std::lock_guard<std::mutex> lock(mutex_);
  journal_.append(line);
}

Study Solver::solve(long_work::Pace& pace) {
  Study study;
  study.samples = all_samples(pace);
  if (task_.counts().search > 0) {
    study.search = search(study.samples, pace);
  }
  const auto worst_sample = std::max_element(
      study.samples.begin(), study.samples.end(),
      [](const PlantRow& a, const PlantRow& b) { return a.badness() < b.badness(); });
  const auto index = static_cast<std::size_t>(worst_sample - study.samples.begin());
  study.worst = {fmt::format("sample {}", index), task_.sample(index), *worst_sample};
  for (const SearchRun& each : study.search) {
    if (each.row.badness() > study.worst.row.badness()) {
      study.worst = {"search", each.factors, each.row};
    }
  }
  return study;
}

std::vector<PlantRow> Solver::all_samples(long_work::Pace& pace) {
  const std::size_t count = task_.counts().samples;
  std::vector<std::size_t> open;
  std::vector<PlantRow> rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto known = known_.find(i);
    if (known == known_.end()) {
      open.push_back(i);
    } else {
      rows[i] = known->second;
    }
  }
  pace.begin(open.size(), static_cast<double>(task_.counts().search) /
                              std::max(1.0, static_cast<double>(open.size())));
  run_samples(task_, open, [&](std::size_t first, const std::vector<PlantRow>& found) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      rows[open[first + i]] = found[i];
      hand_in(open[first + i], found[i]);
    }
    pace.add(found.size());
  });
  return rows;
}

namespace {

Place place_of(const Task& task, const Factors& factors) {
  Place place;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    place.push_back(search_part(task.tolerances()[i], factors[i]));
  }
  return place;
}

bool are_near(const Place& a, const Place& b) {
  constexpr double near = 0.2;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > near) {
      return false;
    }
  }
  return true;
}

/// The worst samples, no two of them near each other.
std::vector<std::size_t> starts(const Task& task, const std::vector<PlantRow>& samples) {
  constexpr std::size_t most_climbs = 4;
  constexpr std::size_t least_runs_per_key = 16;
  const std::size_t count = std::clamp<std::size_t>(
      task.counts().search / (least_runs_per_key * (task.tolerances().size() + 1)), 1, most_climbs);
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return samples[a].badness() > samples[b].badness();
  });
  std::vector<std::size_t> chosen;
  std::vector<Place> places;
  for (std::size_t i = 0; i < order.size() && chosen.size() < count; ++i) {
    Place place = place_of(task, task.sample(order[i]));
    const bool near = std::any_of(places.begin(), places.end(),
                                  [&](const Place& each) { return are_near(each, place); });
    if (!near) {
      chosen.push_back(order[i]);
      places.push_back(std::move(place));
    }
  }
  return chosen;
}

}  // namespace

/// Climbs depend on the samples alone, and each on itself.
std::vector<SearchRun> Solver::search(const std::vector<PlantRow>& samples, long_work::Pace& pace) {
  const std::vector<std::size_t> from = starts(task_, samples);
  const std::size_t runs = task_.counts().search / from.size();
  pace.begin(runs * from.size(), 0.0);
  std::vector<std::vector<SearchRun>> climbs(from.size());
  tbb::parallel_for(std::size_t{0}, from.size(),
                    [&](std::size_t i) { climbs[i] = climb_from(from[i], i, runs, pace); });
  std::vector<SearchRun> all;
  for (std::vector<SearchRun>& each : climbs) {
    std::move(each.begin(), each.end(), std::back_inserter(all));
  }
  return all;
}

std::vector<SearchRun> Solver::climb_from(std::size_t sample, std::size_t ordinal, std::size_t runs,
                                          long_work::Pace& pace) {
  std::vector<SearchRun> found;
  const std::size_t first = task_.counts().samples + ordinal * runs;
  climb(place_of(task_, task_.sample(sample)), runs, [&](std::size_t run, const Place& place) {
    Factors factors;
    for (std::size_t i = 0; i < place.size(); ++i) {
      factors.push_back(search_value(task_.tolerances()[i], place[i]));
    }
    pace.add(1);
    constexpr double of_no_plant = -1.0;
    try {
      found.push_back({ordinal, factors, this->run(first + run, factors)});
    } catch (const scene_file::SceneError&) {
      return of_no_plant;
    }
    return found.back().row.badness();
  });
  return found;
}

PlantRow Solver::run(std::size_t place, const Factors& factors) {
  const auto known = known_.find(place);
  if (known != known_.end()) {
    return known->second;
  }
  PlantRow row = run_plants({task_.plant(factors)}, task_.design()).front();
  hand_in(place, row);
  return row;
}

}  // namespace sonoglide::robust
