#include "host_sim/studies/sweep/sweep.hpp"

#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/batch/run_dahl_plants.hpp"
#include "host_sim/output/output_folder.hpp"
#include "host_sim/shards/collection.hpp"
#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/report.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {
namespace {

namespace fs = std::filesystem;

Plan plan_of(const shards::Work& work) {
  return Plan({work.name + ".toml", work.scene}, work.overrides, work.options,
              most_points_in_shards);
}

/// Every row in the order of the points.
using TakeRow = std::function<void(std::size_t point, PointResult row)>;

void for_each_row(const shards::Collection& found, long_work::Pace& pace, const TakeRow& take) {
  constexpr std::size_t points_per_step = 4096;
  pace.begin(found.work().points, 0.0);
  found.for_each_record([&](std::uint64_t point, const std::string& text) {
    std::optional<Record> record = parse_record(text);
    if (!record || record->point != point) {
      return false;
    }
    take(point, std::move(record->row));
    if ((point + 1) % points_per_step == 0) {
      pace.add(points_per_step);
    }
    return true;
  });
}

}  // namespace

MergeSummary merge_shards(const fs::path& folder, const fs::path& out, const std::string& program,
                          const long_work::Progress& progress) {
  const shards::Collection found(folder);
  found.require_of("sweep", program, batch::arithmetic);
  const Plan plan = plan_of(found.work());
  long_work::Pace pace(progress);
  MergeSummary summary{plan.grid().size(), 0, plan.grid().size() <= most_points};
  const auto count = [&](const PointResult& row) { summary.failed += row.ok() ? 0 : 1; };
  if (summary.drawn) {
    std::vector<PointResult> rows;
    for_each_row(found, pace, [&](std::size_t, PointResult row) {
      count(row);
      rows.push_back(std::move(row));
    });
    write_files(plan, rows, out);
    return summary;
  }
  output::OutputFolder files(out, {table_file, page_file, picture_file});
  std::ostream& table = files.open(table_file);
  write_heading(table, plan);
  for_each_row(found, pace, [&](std::size_t point, const PointResult& row) {
    count(row);
    write_row(table, plan, point, row);
  });
  files.withdraw(page_file);
  files.withdraw(picture_file);
  files.commit();
  return summary;
}

}  // namespace sonoglide::sweep
