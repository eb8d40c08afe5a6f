#include "host_sim/studies/robust/study.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "host_sim/process/thread_limit.hpp"
#include "host_sim/runs/run_many.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/scene_error.hpp"
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

void check_samples(const Task& task, const long_work::PointRange& samples) {
  constexpr std::size_t samples_per_task = 256;
  const std::size_t unusable =
      runs::visit_all(samples.first, samples.end, samples_per_task, [&](std::size_t sample) {
        try {
          task.plant(task.sample(sample));
          return true;
        } catch (const scene_file::SceneError&) {
          return false;
        }
      });
  if (unusable < samples.end) {
    task.plant(task.sample(unusable));
  }
}

namespace {

/// In parts, of which the plants are in memory.
void run_samples(const Task& task, const std::vector<std::uint64_t>& samples,
                 const long_work::Sink& sink) {
  constexpr std::size_t samples_per_thread = 1024;
  constexpr std::size_t samples_per_task = 64;
  const std::size_t most = samples_per_thread * runs::thread_count();
  for (std::size_t begin = 0; begin < samples.size(); begin += most) {
    std::vector<scene::Scene> plants(std::min(most, samples.size() - begin));
    runs::visit_all(0, plants.size(), samples_per_task, [&](std::size_t i) {
      plants[i] = task.plant(task.sample(samples[begin + i]));
      return true;
    });
    run_plants(plants, task.design(), [&](std::vector<Record> rows) {
      for (Record& each : rows) {
        each.point = samples[begin + each.point];
      }
      sink(long_work::finished_points(rows));
    });
  }
}

}  // namespace

long_work::Computation computation_of(const Task& task) {
  return {[&task](const long_work::PointRange&, const std::vector<std::uint64_t>& open,
                  const long_work::Sink& sink) { run_samples(task, open, sink); },
          long_work::record_facts<PlantRow>};
}

Solver::Solver(const Task& task, const std::filesystem::path& folder, const std::string& program,
               std::vector<PlantRow> samples)
    : task_(task),
      samples_(std::move(samples)),
      kept_({0, task.counts().samples}, computation_of(task)),
      journal_(folder / "robust.journal", kind, identity_of(task, program),
               [this](std::string_view record) { return take(record); }) {}

/// The search begins when all samples are finished.
bool Solver::take(std::string_view text) {
  std::optional<Record> record = long_work::parse_record<PlantRow>(text);
  const Counts& counts = task_.counts();
  if (!record || record->point >= counts.samples + counts.search) {
    return false;
  }
  if (record->point < counts.samples) {
    return kept_.take(text);
  }
  searched_.insert_or_assign(record->point, std::move(record->row));
  return kept_.complete() || !samples_.empty();
}

std::size_t Solver::found_finished() const {
  return (samples_.empty() ? kept_.finished() : samples_.size()) + searched_.size();
}

Study Solver::solve(const long_work::Progress& progress) {
  long_work::Pace pace(progress);
  complete_samples(pace);
  Study study;
  if (task_.counts().search > 0) {
    study.search = search(pace);
  }
  study.samples = std::move(samples_);
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

void Solver::complete_samples(long_work::Pace& pace) {
  if (samples_.empty()) {
    kept_.compute(journal_, pace, task_.counts().search);
    kept_.for_each_record(journal_, long_work::rows_to<PlantRow>([this](std::size_t, PlantRow row) {
                            samples_.push_back(std::move(row));
                          }));
  }
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
std::vector<SearchRun> Solver::search(long_work::Pace& pace) {
  const std::vector<std::size_t> from = starts(task_, samples_);
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
  const auto known = searched_.find(place);
  if (known != searched_.end()) {
    return known->second;
  }
  PlantRow row = run_plants({task_.plant(factors)}, task_.design()).front();
  journal_.append({{place, long_work::record_text<PlantRow>({place, row})}});
  return row;
}

}  // namespace sonoglide::robust
