#include "host_sim/studies/sweep/sweep.hpp"

#include <optional>
#include <string_view>
#include <vector>

#include "host_sim/batch/run_dahl_plants.hpp"
#include "host_sim/studies/sweep/row.hpp"
#include "host_sim/studies/sweep/solve.hpp"

namespace sonoglide::sweep {
namespace {

shards::Work work_of(const Plan& plan, const std::string& program, std::uint64_t shards) {
  return {"sweep",
          program,
          batch::arithmetic,
          plan.source().name(),
          plan.source().text,
          plan.overrides(),
          plan.vary(),
          plan.grid().size(),
          shards};
}

void check(const Plan& plan, const PointRange& points, long_work::Pace& pace) {
  pace.begin(points.size(), 1.0 + expected_solving_cost(plan, points));
  plan.visit(
      points, [](std::size_t, const scene::Scene&) {}, &pace);
}

void compute(const Plan& plan, const PointRange& block, const Points& open,
             const shards::Sink& sink) {
  const Solve solve(plan, block, nullptr);
  solve_all(solve, open, [&](const std::vector<Record>& records) {
    std::vector<shards::FinishedPoint> finished;
    finished.reserve(records.size());
    for (const Record& record : records) {
      finished.push_back({record.point, record_text(record)});
    }
    sink(finished);
  });
}

std::optional<shards::RecordFacts> facts(std::string_view text) {
  const std::optional<Record> record = parse_record(text);
  return record ? std::optional<shards::RecordFacts>({record->point, !record->row.ok()})
                : std::nullopt;
}

}  // namespace

shards::ShardSummary run_shard(const Plan& plan, const shards::Shard& shard,
                               const std::filesystem::path& folder, const std::string& program,
                               unsigned threads, const long_work::Progress& progress) {
  const shards::Computation computation = {
      [&plan](const PointRange& points, long_work::Pace& pace) { check(plan, points, pace); },
      [&plan](const PointRange& block, const Points& open, const shards::Sink& sink) {
        compute(plan, block, open, sink);
      },
      facts};
  return shards::run_shard({work_of(plan, program, shard.count), shard.number}, computation, folder,
                           threads, progress);
}

}  // namespace sonoglide::sweep
