#include "host_sim/studies/robust/run_plants.hpp"

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

}  // namespace

std::vector<PlantRow> run_plants(const std::vector<scene::Scene>& plants,
                                 const configure::ControlDesign& design) {
  std::vector<PlantRow> rows;
  rows.reserve(plants.size());
  for (const scene::Scene& plant : plants) {
    rows.push_back(run_plant(plant, design));
  }
  return rows;
}

}  // namespace sonoglide::robust
