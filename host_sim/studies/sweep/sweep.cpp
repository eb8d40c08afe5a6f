#include "host_sim/studies/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "host_sim/batch/run_dahl_plants.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/output/output_folder.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/process/ending.hpp"
#include "host_sim/scene_file/to_json.hpp"
#include "host_sim/studies/sweep/free_vibration.hpp"
#include "host_sim/studies/sweep/journal.hpp"
#include "host_sim/studies/sweep/report.hpp"

namespace sonoglide::sweep {
namespace {

/// Where the threads hand in what they have finished.
class Collection {
 public:
  Collection(std::size_t points, Journal& journal, long_work::Pace& pace)
      : rows_(points), known_(points), journal_(journal), pace_(pace) {
    for (const Record& record : journal.finished()) {
      take(record);
    }
  }

  void hand_in(std::vector<Record> records) {
    // The text is made before the lock: that is most of the work.
    const std::string text = Journal::text_of(records);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      journal_.append(text);
      for (Record& record : records) {
        take(std::move(record));
      }
    }
    pace_.add(records.size());
  }

  Points open_points() const {
    Points open;
    for (std::size_t point = 0; point < known_.size(); ++point) {
      if (!known_[point]) {
        open.push_back(point);
      }
    }
    return open;
  }

  std::vector<PointResult> take_rows() { return std::move(rows_); }

 private:
  void take(Record record) {
    known_[record.point] = true;
    rows_[record.point] = std::move(record.row);
  }

  std::mutex mutex_;
  std::vector<PointResult> rows_;
  std::vector<bool> known_;
  Journal& journal_;
  long_work::Pace& pace_;
};

}  // namespace

std::vector<PointResult> compute(const Solve& solve, std::size_t points, Journal& journal,
                                 long_work::Pace& pace) {
  Collection collection(points, journal, pace);
  const Points open = collection.open_points();
  pace.begin(open.size(), 0.0);
  solve_all(solve, open,
            [&](std::vector<Record> records) { collection.hand_in(std::move(records)); });
  return collection.take_rows();
}

namespace {

namespace fs = std::filesystem;

std::string values_of(const Axis& axis) {
  if (axis.list.empty()) {
    return fmt::format("{}:{}:{}{}", axis.from, axis.to, axis.count,
                       axis.logarithmic ? ":log" : "");
  }
  std::string values;
  for (const ListedValue& each : axis.list) {
    values += each.text + ',';
  }
  return values;
}

/// Of what words are varied the scenes differ in more than a value: each is told in full.
Identity identity_of(const Plan& plan, const std::string& program) {
  std::string vary;
  for (const Axis& axis : plan.grid().axes()) {
    vary += fmt::format("{}={} ", axis.key, values_of(axis));
  }
  std::string scenes;
  for (const std::size_t point : plan.wordings()) {
    scenes += scene_file::to_json(plan.scene(point)).dump();
  }
  return {program, scenes, vary};
}

}  // namespace

void write_files(const Plan& plan, const std::vector<PointResult>& rows, const fs::path& out,
                 const std::function<void()>& then) {
  const std::optional<std::string> picture = draw(plan, rows);
  const std::string page = output::to_html(sweep_page(plan, rows, picture));
  output::OutputFolder folder(out);
  write_csv(folder.open(table_file), plan, rows);
  folder.write(page_file, page);
  if (picture) {
    folder.write(picture_file, *picture);
  } else {
    folder.withdraw(picture_file);
  }
  const process::Undisturbed now;
  folder.commit();
  then();
}

Summary run_sweep(const Plan& plan, const fs::path& out, const std::string& program,
                  unsigned threads, const long_work::Progress& progress) {
  const shards::ThreadLimit limit(threads);
  const auto begin = std::chrono::steady_clock::now();
  long_work::Pace pace(progress);
  const Solve solve(plan, plan.all(), &pace);
  if (!drawn_axes(plan.grid()).empty() && drawn_axes(plan.grid()).size() <= 2) {
    output::require_gnuplot();
  }
  output::create_folder(out, {table_file, page_file, picture_file});
  // Rows of another arithmetic, which an earlier program had, do not mix with these.
  const std::string decisive = fmt::format("{}, {}", program, batch::arithmetic);
  Journal journal(out, identity_of(plan, decisive), plan.grid().size());
  const std::size_t found = journal.finished().size();
  const std::vector<PointResult> rows = compute(solve, plan.grid().size(), journal, pace);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  write_files(plan, rows, out, [&] { journal.remove(); });
  const auto failed =
      std::count_if(rows.begin(), rows.end(), [](const PointResult& row) { return !row.ok(); });
  return {rows.size(), static_cast<std::size_t>(failed), found, wall.count(), start_notes(plan)};
}

}  // namespace sonoglide::sweep
