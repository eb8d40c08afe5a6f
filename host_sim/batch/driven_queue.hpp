/// The driven plants still to be run, and those that lanes are running.
#pragma once

#include <array>
#include <cstddef>

#include "host_sim/batch/lane_plant.hpp"
#include "host_sim/batch/run_driven_plants.hpp"

namespace sonoglide::batch {

/// Hands out plants, a carrier period at a time, as RunQueue does.
class DrivenQueue {
 public:
  DrivenQueue(const DahlPlant* plants, std::size_t count, DriveSource& source, RunStatus* statuses)
      : plants_(plants), count_(count), source_(source), statuses_(statuses) {}

  bool busy() const { return busy_ > 0; }
  LanePlant next(std::size_t lane);
  LanePlant give_up(std::size_t lane);
  bool goes_on(std::size_t lane, const Progress& progress);
  LaneStretch stretch(std::size_t lane) const {
    return lanes_[lane].idle ? endless : LaneStretch{1.0, lanes_[lane].drive_amplitude};
  }

 private:
  struct Lane {
    bool idle = true;
    std::size_t point = 0;
    double drive_amplitude = 0.0;
  };

  void end(Lane& lane, RunStatus status);

  const DahlPlant* plants_;
  std::size_t count_;
  DriveSource& source_;
  RunStatus* statuses_;
  std::size_t next_point_ = 0;
  std::size_t busy_ = 0;
  std::array<Lane, most_lanes> lanes_;
};

}  // namespace sonoglide::batch
