#include "host_sim/runs/batch/run_dahl_plants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "firmware/numeric/turn.hpp"
#include "host_sim/runs/batch/lane_queue.hpp"

#define HWY_TARGET_INCLUDE "host_sim/runs/batch/dahl_lanes.hpp"
#include <hwy/foreach_target.h>
// The last of the targets is left to this one.
#include "host_sim/runs/batch/dahl_lanes.hpp"

namespace sonoglide::batch {

HWY_EXPORT(target_name);
HWY_EXPORT(run_map);
HWY_EXPORT(run_fine);

namespace {

constexpr std::uint32_t longest_stretch_periods = 64;

/// A run is divided into stretches, so that a lane's sums stay short and its phase exact; the window
/// begins with one.
class RunQueue : public LaneQueue {
 public:
  RunQueue(const DahlPlant* plants, std::size_t count, const RunLength& length, DahlRun* runs)
      : LaneQueue(plants, count), length_(length), runs_(runs) {}

 private:
  struct Sums {
    std::uint32_t periods_done = 0;
    FrictionAverages before_window;  ///< integrals
    FrictionAverages window;
  };

  void set_status(std::size_t point, RunStatus status) override { runs_[point].status = status; }

  LaneStretch first_stretch(std::size_t lane, std::size_t point) override {
    sums_[lane] = Sums();
    return stretch_of(lane, point);
  }

  std::optional<LaneStretch> next_stretch(std::size_t lane, std::size_t point,
                                          const Progress& progress) override {
    Sums& sums = sums_[lane];
    const bool in_window = sums.periods_done >= length_.window_start_periods;
    FrictionAverages& part = in_window ? sums.window : sums.before_window;
    part.friction_ratio += progress.integrals.friction_ratio;
    part.friction_work += progress.integrals.friction_work;
    sums.periods_done += stretch_periods(sums);
    if (sums.periods_done < length_.periods) {
      return stretch_of(lane, point);
    }
    finish(sums, progress.state, runs_[point]);
    return std::nullopt;
  }

  std::uint32_t stretch_periods(const Sums& sums) const {
    const std::uint32_t goal = sums.periods_done < length_.window_start_periods
                                   ? length_.window_start_periods
                                   : length_.periods;
    return std::min(goal - sums.periods_done, longest_stretch_periods);
  }

  LaneStretch stretch_of(std::size_t lane, std::size_t point) const {
    return {static_cast<double>(stretch_periods(sums_[lane])), {plant(point).drive_amplitude}};
  }

  void finish(const Sums& sums, const plant::State<double>& state, DahlRun& run) const {
    const double duration = numeric::two_pi * length_.periods;
    const double window = numeric::two_pi * (length_.periods - length_.window_start_periods);
    run.final_state = state;
    run.whole = {(sums.before_window.friction_ratio + sums.window.friction_ratio) / duration,
                 sums.before_window.friction_work + sums.window.friction_work};
    run.window = {sums.window.friction_ratio / window, sums.window.friction_work};
  }

  RunLength length_;
  DahlRun* runs_;
  std::array<Sums, most_lanes> sums_;
};

}  // namespace

std::string instruction_set() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

void run_dahl_plants(const DahlPlant* plants, std::size_t count, const RunLength& length,
                     Accuracy accuracy, DahlRun* runs) {
  std::fill(runs, runs + count, DahlRun());
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
