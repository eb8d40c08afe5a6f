#include "host_sim/studies/sweep/solve.hpp"

#include <tbb/parallel_for_each.h>

#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "host_sim/studies/sweep/expected_cost.hpp"
#include "host_sim/studies/sweep/scalar_point.hpp"

namespace sonoglide::sweep {
namespace {

/// What points that can be run together have in common.
using GroupKey = std::tuple<std::uint32_t, std::uint32_t, batch::Accuracy>;

GroupKey key_of(const BatchPoint& point) {
  return {point.length.periods, point.length.window_start_periods, point.accuracy};
}

}  // namespace

Solve::Solve(const Plan& plan, Pace& pace) : plan_(plan), batch_points_(plan.grid().size()) {
  pace.begin(plan.grid().size(), expected_solving_cost(plan));
  plan.visit_all([this](std::size_t point,
                        const scene::Scene& scene) { batch_points_[point] = batch_point(scene); },
                 &pace);
}

std::vector<Points> Solve::calls(const Points& points) const {
  constexpr std::size_t lanes_many_times_over = 256;
  std::vector<Points> calls;
  std::map<GroupKey, Points> groups;
  for (const std::size_t point : points) {
    const auto& batch = batch_points_[point];
    Points& group = batch ? groups[key_of(*batch)] : calls.emplace_back();
    group.push_back(point);
    if (group.size() == lanes_many_times_over) {
      calls.push_back(std::exchange(group, {}));
    }
  }
  for (auto& [key, group] : groups) {
    if (!group.empty()) {
      calls.push_back(std::move(group));
    }
  }
  return calls;
}

void Solve::operator()(const Points& call, const Sink& sink) const {
  const Points singles = batch_points_[call.front()] ? over_lanes(call, sink) : call;
  tbb::parallel_for_each(singles, [&](std::size_t point) {
    sink({{point, solve_scalar_point(plan_.scene(point))}});
  });
}

/// @return what the lanes give up
Points Solve::over_lanes(const Points& call, const Sink& sink) const {
  std::vector<batch::DahlPlant> plants;
  for (const std::size_t point : call) {
    plants.push_back(batch_points_[point]->plant);
  }
  const BatchPoint& any = *batch_points_[call.front()];
  const std::vector<batch::DahlRun> runs = batch::run_dahl_plants(plants, any.length, any.accuracy);
  std::vector<Record> records;
  Points given_up;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].status == batch::RunStatus::solved) {
      records.push_back({call[i], row_of(*batch_points_[call[i]], runs[i])});
    } else {
      given_up.push_back(call[i]);
    }
  }
  sink(std::move(records));
  return given_up;
}

}  // namespace sonoglide::sweep
