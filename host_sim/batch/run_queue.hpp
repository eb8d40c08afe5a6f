/// The plants still to be run, and those that lanes are running.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/plant/state.hpp"
#include "host_sim/batch/lane_plant.hpp"
#include "host_sim/batch/run_dahl_plants.hpp"

namespace sonoglide::batch {

/// Hands out plants and takes results in. A run is divided into stretches, so that a lane's sums
/// stay short and its phase exact; the window begins with one.
class RunQueue {
 public:
  RunQueue(const DahlPlant* plants, std::size_t count, const RunLength& length, DahlRun* runs)
      : plants_(plants), count_(count), length_(length), runs_(runs) {}

  bool busy() const { return busy_ > 0; }

  /// The next plant that lanes can run, or one at rest that idles in a lane which nobody needs.
  LanePlant next(std::size_t lane);

  /// The same, after the lane could not decide a reversal of its plant.
  LanePlant give_up(std::size_t lane);

  /// Takes the lane's stretch in. False where the run has ended, well or not.
  bool goes_on(std::size_t lane, const Progress& progress);

  /// What the lane does until it stops again.
  LaneStretch stretch(std::size_t lane) const;

 private:
  struct Lane {
    bool idle = true;
    std::size_t point = 0;
    std::uint32_t periods_done = 0;
    FrictionAverages before_window;  ///< integrals
    FrictionAverages window;
  };

  std::uint32_t stretch_periods(const Lane& lane) const;
  void end(Lane& lane, RunStatus status);
  void finish(Lane& lane, const plant::State<double>& state);

  const DahlPlant* plants_;
  std::size_t count_;
  RunLength length_;
  DahlRun* runs_;
  std::size_t next_point_ = 0;
  std::size_t busy_ = 0;
  std::array<Lane, most_lanes> lanes_;
};

}  // namespace sonoglide::batch
