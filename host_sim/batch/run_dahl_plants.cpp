#include "host_sim/batch/run_dahl_plants.hpp"

#include "host_sim/batch/run_queue.hpp"

#define HWY_TARGET_INCLUDE "host_sim/batch/dahl_lanes.hpp"
#include <hwy/foreach_target.h>
// The last of the targets is left to this one.
#include "host_sim/batch/dahl_lanes.hpp"

namespace sonoglide::batch {

HWY_EXPORT(target_name);
HWY_EXPORT(run_map);
HWY_EXPORT(run_fine);

std::string instruction_set() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

void run_dahl_plants(const DahlPlant* plants, std::size_t count, const RunLength& length,
                     Accuracy accuracy, DahlRun* runs) {
  RunQueue queue(plants, count, length, runs);
  if (accuracy == Accuracy::map) {
    HWY_DYNAMIC_DISPATCH(run_map)(queue);
  } else {
    HWY_DYNAMIC_DISPATCH(run_fine)(queue);
  }
}

std::vector<DahlRun> run_dahl_plants(const std::vector<DahlPlant>& plants, const RunLength& length,
                                     Accuracy accuracy) {
  std::vector<DahlRun> runs(plants.size());
  run_dahl_plants(plants.data(), plants.size(), length, accuracy, runs.data());
  return runs;
}

}  // namespace sonoglide::batch
