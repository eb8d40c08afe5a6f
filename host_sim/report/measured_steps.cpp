#include "host_sim/loop/run.hpp"
#include "host_sim/report/step_metrics.hpp"

namespace sonoglide::report {

std::vector<StepMetrics> measured_steps(const scene::Scene& plant,
                                        const configure::ControlDesign& design) {
  StepMeter meter(plant, design);
  loop::Watch watch;
  watch.periods.push_back(&meter);
  watch.energies = false;
  loop::run(plant, design, watch);
  return meter.steps();
}

}  // namespace sonoglide::report
