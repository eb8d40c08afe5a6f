#include "host_sim/studies/robust/run_plants.hpp"

#include <cstddef>

#include "host_sim/lanes/closed_loops.hpp"
#include "host_sim/loop/run.hpp"

namespace sonoglide::robust {
namespace {

PlantRow run_plant(const scene::Scene& plant, const configure::ControlDesign& design) {
  report::StepMeter meter(plant);
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

using Places = std::vector<std::size_t>;

/// @return what the lanes give up
Places run_in_lanes(const std::vector<scene::Scene>& plants, const Places& places,
                    const configure::ControlDesign& design, std::vector<PlantRow>& rows) {
  std::vector<report::StepMeter> meters;
  meters.reserve(places.size());
  std::vector<lanes::ClosedLoop> loops;
  for (const std::size_t place : places) {
    loops.push_back({plants[place], design, meters.emplace_back(plants[place])});
  }
  const std::vector<lanes::LoopRun> runs = lanes::run_closed_loops(loops);
  Places given_up;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (runs[i].status == batch::RunStatus::solved) {
      rows[places[i]] = row_of(meters[i].steps(), runs[i].control);
    } else {
      given_up.push_back(places[i]);
    }
  }
  return given_up;
}

}  // namespace

std::vector<PlantRow> run_plants(const std::vector<scene::Scene>& plants,
                                 const configure::ControlDesign& design) {
  Places together;
  Places singles;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    (lanes::runs_in_lanes(plants[i]) ? together : singles).push_back(i);
  }
  std::vector<PlantRow> rows(plants.size());
  const Places given_up = run_in_lanes(plants, together, design, rows);
  singles.insert(singles.end(), given_up.begin(), given_up.end());
  for (const std::size_t place : singles) {
    rows[place] = run_plant(plants[place], design);
  }
  return rows;
}

}  // namespace sonoglide::robust
