#include "host_sim/batch/run_driven_plants.hpp"

#include "host_sim/batch/driven_queue.hpp"

#define HWY_TARGET_INCLUDE "host_sim/batch/driven_lanes.hpp"
#include <hwy/foreach_target.h>
// The last of the targets is left to this one.
#include "host_sim/batch/driven_lanes.hpp"

namespace sonoglide::batch {

HWY_EXPORT(run_driven);

void run_driven_plants(const DahlPlant* plants, std::size_t count, DriveSource& source,
                       RunStatus* statuses) {
  DrivenQueue queue(plants, count, source, statuses);
  HWY_DYNAMIC_DISPATCH(run_driven)(queue);
}

std::vector<RunStatus> run_driven_plants(const std::vector<DahlPlant>& plants,
                                         DriveSource& source) {
  std::vector<RunStatus> statuses(plants.size());
  run_driven_plants(plants.data(), plants.size(), source, statuses.data());
  return statuses;
}

}  // namespace sonoglide::batch
