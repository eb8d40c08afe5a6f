#include "host_sim/runs/batch/run_dahl_plants.hpp"

#include "firmware/numeric/turn.hpp"
#include "host_sim/runs/batch/lane_queue.hpp"

#define HWY_TARGET_INCLUDE "host_sim/runs/batch/driven_lanes.hpp"
#include <hwy/foreach_target.h>
// The last of the targets is left to this one.
#include "host_sim/runs/batch/driven_lanes.hpp"

namespace sonoglide::batch {

HWY_EXPORT(run_driven);
HWY_EXPORT(run_ramped);

namespace {

/// Stretches of a carrier period.
class DrivenQueue : public LaneQueue {
 public:
  DrivenQueue(const DahlPlant* plants, std::size_t count, DriveSource& source, RunStatus* statuses)
      : LaneQueue(plants, count), source_(source), statuses_(statuses) {}

 private:
  void set_status(std::size_t point, RunStatus status) override { statuses_[point] = status; }

  LaneStretch first_stretch(std::size_t /*lane*/, std::size_t point) override {
    return {1.0, {plant(point).drive_amplitude}};
  }

  std::optional<LaneStretch> next_stretch(std::size_t /*lane*/, std::size_t point,
                                          const Progress& progress) override {
    const std::optional<DriveAmplitude> drive =
        source_.next_amplitude(point, progress.integrals.friction_ratio / numeric::two_pi);
    return drive ? std::optional(LaneStretch{1.0, *drive}) : std::nullopt;
  }

  DriveSource& source_;
  RunStatus* statuses_;
};

}  // namespace

void run_driven_plants(const DahlPlant* plants, std::size_t count, DriveSource& source,
                       RunStatus* statuses) {
  DrivenQueue queue(plants, count, source, statuses);
  if (source.ramps()) {
    HWY_DYNAMIC_DISPATCH(run_ramped)(queue);
  } else {
    HWY_DYNAMIC_DISPATCH(run_driven)(queue);
  }
}

std::vector<RunStatus> run_driven_plants(const std::vector<DahlPlant>& plants,
                                         DriveSource& source) {
  std::vector<RunStatus> statuses(plants.size());
  run_driven_plants(plants.data(), plants.size(), source, statuses.data());
  return statuses;
}

}  // namespace sonoglide::batch
