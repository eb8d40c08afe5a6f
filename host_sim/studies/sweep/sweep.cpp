#include "host_sim/studies/sweep/sweep.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include "host_sim/long_work/collection.hpp"
#include "host_sim/long_work/journal.hpp"
#include "host_sim/output/gnuplot.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/output/program.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/process/thread_limit.hpp"
#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/studies/sweep/free_vibration.hpp"
#include "host_sim/studies/sweep/report.hpp"
#include "host_sim/studies/sweep/solve.hpp"

namespace sonoglide::sweep {
namespace {

namespace fs = std::filesystem;

constexpr long_work::JournalKind journal_kind = {"sweep", "--vary"};

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
long_work::Identity identity_of(const Plan& plan, const std::string& program) {
  std::string vary;
  for (const Axis& axis : plan.grid().axes()) {
    vary += fmt::format("{}={} ", axis.key, values_of(axis));
  }
  std::string scenes;
  for (const std::size_t point : plan.wordings()) {
    scenes += scene_file::to_json(plan.experiment(point).nominal).dump();
  }
  // Rows of another arithmetic, which an earlier program had, do not mix with these.
  return {fmt::format("{}, {}", program, batch::arithmetic), scenes, vary};
}

/// The table, the picture and the page of all rows, all or none.
void write_files(const Plan& plan, const std::vector<PointResult>& rows, const fs::path& out,
                 const std::function<void()>& then) {
  const std::optional<output::Sheet> picture = sweep::picture(plan, rows);
  const std::string svg = picture ? output::print(*picture) : std::string();
  const std::string page = output::to_html(sweep_page(plan, rows, picture));
  process::OutputFolder folder(out);
  write_csv(folder.open(table_file), plan, rows);
  folder.write(page_file, page);
  if (picture) {
    folder.write(picture_file, svg);
  } else {
    folder.withdraw(picture_file);
  }
  folder.commit(then);
}

/// Gives the record of every point, in their order.
using Records = std::function<void(const long_work::TakeRecord& take)>;

/// Makes the files of a sweep's records.
/// @param then  what belongs to it: no signal ends the program between
MergeSummary merge(const Plan& plan, const Records& records, const fs::path& out,
                   const std::function<void()>& then = {}) {
  MergeSummary summary{plan.grid().size(), 0, plan.grid().size() <= most_points};
  const auto for_each_row = [&](const auto& take) {
    records(long_work::rows_to<PointResult>([&](std::size_t point, PointResult row) {
      summary.failed += row.ok() ? 0 : 1;
      take(point, std::move(row));
    }));
  };
  if (summary.drawn) {
    std::vector<PointResult> rows;
    for_each_row([&](std::size_t, PointResult row) { rows.push_back(std::move(row)); });
    write_files(plan, rows, out, then);
    return summary;
  }
  process::OutputFolder files(out, {table_file, page_file, picture_file});
  std::ostream& table = files.open(table_file);
  write_heading(table, plan);
  for_each_row(
      [&](std::size_t point, const PointResult& row) { write_row(table, plan, point, row); });
  files.withdraw(page_file);
  files.withdraw(picture_file);
  files.commit();
  return summary;
}

}  // namespace

Summary run_sweep(const Plan& plan, const fs::path& out, const std::string& program,
                  unsigned threads, const long_work::Progress& progress) {
  const process::ThreadLimit limit(threads);
  const double begin_s = long_work::steady_time_s();
  long_work::Pace pace(progress);
  const Solve solve(plan, plan.all(), &pace);
  if (!drawn_axes(plan.grid()).empty() && drawn_axes(plan.grid()).size() <= 2) {
    output::require_gnuplot();
  }
  process::create_folder(out, {table_file, page_file, picture_file});
  long_work::KeptPoints points(plan.all(),
                               {[&solve](const PointRange&, const runs::Places& open,
                                         const long_work::Sink& sink) { solve(open, sink); },
                                long_work::record_facts<PointResult>});
  long_work::Journal journal(out / "sweep.journal", journal_kind, identity_of(plan, program),
                             [&points](std::string_view record) { return points.take(record); });
  const std::size_t found = points.finished();
  points.compute(journal, pace);
  const double wall_s = long_work::steady_time_s() - begin_s;
  const MergeSummary merged = merge(
      plan, [&](const long_work::TakeRecord& take) { points.for_each_record(journal, take); }, out,
      [&journal] { journal.remove(); });
  return {merged.points, merged.failed, found, wall_s, start_notes(plan)};
}

long_work::ShardSummary run_shard(const Plan& plan, const long_work::Shard& shard,
                                  const fs::path& folder, const std::string& program,
                                  unsigned threads, const long_work::Progress& progress) {
  const process::ThreadLimit limit(threads);
  const auto check = [&plan](const PointRange& points, long_work::Pace& pace) {
    pace.begin(points.size(), 1.0 + expected_solving_cost(plan, points));
    plan.visit(
        points, [](std::size_t, const experiment::Experiment&) {}, &pace);
  };
  const auto compute = [&plan](const PointRange& block, const runs::Places& open,
                               const long_work::Sink& sink) {
    Solve(plan, block, nullptr)(open, sink);
  };
  const long_work::Work work{
      "sweep",          program,     batch::arithmetic,  plan.source().name(), plan.source().text,
      plan.overrides(), plan.vary(), plan.grid().size(), shard.count};
  return long_work::run_shard({work, shard.number}, check,
                              {compute, long_work::record_facts<PointResult>}, folder, progress);
}

MergeSummary merge_shards(const fs::path& folder, const fs::path& out, const std::string& program,
                          const long_work::Progress& progress) {
  const long_work::Collection found(folder);
  found.require_of("sweep", program, batch::arithmetic);
  const long_work::Work& work = found.work();
  const Plan plan({work.name + ".toml", work.scene}, work.overrides, work.options,
                  most_points_in_shards);
  output::program().changed = scene_file::changes(plan.source(), plan.overrides());
  constexpr std::size_t points_per_step = 4096;
  long_work::Pace pace(progress);
  pace.begin(work.points, 0.0);
  return merge(
      plan,
      [&](const long_work::TakeRecord& take) {
        found.for_each_record([&](std::uint64_t point, const std::string& record) {
          if ((point + 1) % points_per_step == 0) {
            pace.add(points_per_step);
          }
          return take(point, record);
        });
      },
      out);
}

}  // namespace sonoglide::sweep
