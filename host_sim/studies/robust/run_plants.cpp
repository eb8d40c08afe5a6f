#include "host_sim/studies/robust/study.hpp"

#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "host_sim/loop/run.hpp"
#include "host_sim/runs/closed_loops.hpp"
#include "host_sim/runs/run_many.hpp"

namespace sonoglide::robust {
namespace {

PlantRow run_plant(const scene::Scene& plant, const configure::ControlDesign& design) {
  report::StepMeter meter(plant, design);
  loop::Watch watch;
  watch.periods.push_back(&meter);
  watch.energies = false;
  try {
    const loop::RunResult result = loop::run(plant, design, watch);
    return row_of(meter.steps(), *result.control);
  } catch (const loop::ComputationError& error) {
    return failed_row(error.what());
  }
}

/// @return what the lanes give up
runs::Places run_in_lanes(const std::vector<scene::Scene>& plants, const runs::Places& places,
                          const configure::ControlDesign& design, const TakeRows& take) {
  std::vector<report::StepMeter> meters;
  meters.reserve(places.size());
  std::vector<runs::ClosedLoop> loops;
  for (const std::size_t place : places) {
    loops.push_back({plants[place], design, meters.emplace_back(plants[place], design)});
  }
  const std::vector<runs::LoopRun> found = runs::run_closed_loops(loops);
  std::vector<Record> rows;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (found[i].status == batch::RunStatus::solved) {
      rows.push_back({places[i], row_of(meters[i].steps(), found[i].control)});
    }
  }
  take(std::move(rows));
  return runs::given_up(places, found);
}

}  // namespace

void run_plants(const std::vector<scene::Scene>& plants, const configure::ControlDesign& design,
                const TakeRows& take) {
  runs::Places all(plants.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const runs::Calls calls = runs::divide(all, [&](std::size_t place) {
    return runs::runs_in_lanes(plants[place]) ? std::optional(0) : std::nullopt;
  });
  runs::run_many(
      calls, [&](const runs::Places& places) { return run_in_lanes(plants, places, design, take); },
      [&](std::size_t place) {
        take({{place, run_plant(plants[place], design)}});
      });
}

std::vector<PlantRow> run_plants(const std::vector<scene::Scene>& plants,
                                 const configure::ControlDesign& design) {
  std::vector<PlantRow> rows(plants.size());
  run_plants(plants, design, [&rows](std::vector<Record> found) {
    for (Record& record : found) {
      rows[record.point] = std::move(record.row);
    }
  });
  return rows;
}

}  // namespace sonoglide::robust
