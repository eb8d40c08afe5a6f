#include "host_sim/sweep/solve.hpp"

#include <tbb/parallel_for_each.h>

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "host_sim/sweep/expected_cost.hpp"
#include "host_sim/sweep/scalar_point.hpp"

namespace sonoglide::sweep {
namespace {

/// Points that can be run together.
struct Group {
  std::vector<std::size_t> points;
  std::vector<BatchPoint> batch_points;
};

using GroupKey = std::tuple<std::uint32_t, std::uint32_t, batch::Accuracy>;

GroupKey key_of(const BatchPoint& point) {
  return {point.length.periods, point.length.window_start_periods, point.accuracy};
}

/// Adds to `singles` what the lanes give up.
std::vector<Record> solve_group(const Group& group, std::vector<std::size_t>& singles) {
  std::vector<batch::DahlPlant> plants;
  for (const BatchPoint& point : group.batch_points) {
    plants.push_back(point.plant);
  }
  const BatchPoint& any = group.batch_points.front();
  const std::vector<batch::DahlRun> runs = batch::run_dahl_plants(plants, any.length, any.accuracy);
  std::vector<Record> records;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].status == batch::RunStatus::solved) {
      records.push_back({group.points[i], row_of(group.batch_points[i], runs[i])});
    } else {
      singles.push_back(group.points[i]);
    }
  }
  return records;
}

}  // namespace

Solve::Solve(const Plan& plan, Pace& pace) : plan_(plan), batch_points_(plan.grid().size()) {
  pace.begin(plan.grid().size(), expected_solving_cost(plan.first()));
  plan.visit_all([this](std::size_t point,
                        const scene::Scene& scene) { batch_points_[point] = batch_point(scene); },
                 &pace);
}

std::size_t Solve::points_per_call() const {
  constexpr std::size_t lanes_many_times_over = 256;
  return batch_points_.front() ? lanes_many_times_over : 1;
}

void Solve::operator()(const std::vector<std::size_t>& points, const Sink& sink) const {
  std::map<GroupKey, Group> groups;
  std::vector<std::size_t> singles;
  for (const std::size_t point : points) {
    if (const auto& batch = batch_points_[point]) {
      Group& group = groups[key_of(*batch)];
      group.points.push_back(point);
      group.batch_points.push_back(*batch);
    } else {
      singles.push_back(point);
    }
  }
  for (const auto& [key, group] : groups) {
    sink(solve_group(group, singles));
  }
  tbb::parallel_for_each(singles, [&](std::size_t point) {
    sink({{point, solve_scalar_point(plan_.scene(point))}});
  });
}

}  // namespace sonoglide::sweep
