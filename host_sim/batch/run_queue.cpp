#include "host_sim/batch/run_queue.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::batch {
namespace {

constexpr std::uint32_t longest_stretch_periods = 64;

}  // namespace

LanePlant RunQueue::next(std::size_t lane) {
  for (; next_point_ < count_; ++next_point_) {
    runs_[next_point_] = DahlRun();
    if (suits_lanes(plants_[next_point_])) {
      lanes_[lane] = Lane();
      lanes_[lane].idle = false;
      lanes_[lane].point = next_point_;
      ++busy_;
      return prepare(plants_[next_point_++]);
    }
  }
  return idling;
}

LanePlant RunQueue::give_up(std::size_t lane) {
  end(lanes_[lane], RunStatus::undecided_reversal);
  return next(lane);
}

bool RunQueue::goes_on(std::size_t at, const Progress& progress) {
  Lane& lane = lanes_[at];
  if (lane.idle) {
    return false;
  }
  const RunStatus status = status_of(progress);
  if (status != RunStatus::solved) {
    end(lane, status);
    return false;
  }
  const bool in_window = lane.periods_done >= length_.window_start_periods;
  FrictionAverages& sums = in_window ? lane.window : lane.before_window;
  sums.friction_ratio += progress.integrals.friction_ratio;
  sums.friction_work += progress.integrals.friction_work;
  lane.periods_done += stretch_periods(lane);
  if (lane.periods_done < length_.periods) {
    return true;
  }
  finish(lane, progress.state);
  return false;
}

LaneStretch RunQueue::stretch(std::size_t at) const {
  const Lane& lane = lanes_[at];
  return lane.idle ? endless
                   : LaneStretch{static_cast<double>(stretch_periods(lane)),
                                 plants_[lane.point].drive_amplitude};
}

std::uint32_t RunQueue::stretch_periods(const Lane& lane) const {
  const std::uint32_t goal = lane.periods_done < length_.window_start_periods
                                 ? length_.window_start_periods
                                 : length_.periods;
  return std::min(goal - lane.periods_done, longest_stretch_periods);
}

void RunQueue::end(Lane& lane, RunStatus status) {
  runs_[lane.point].status = status;
  lane.idle = true;
  --busy_;
}

void RunQueue::finish(Lane& lane, const plant::State<double>& state) {
  const double duration = numeric::two_pi * length_.periods;
  const double window = numeric::two_pi * (length_.periods - length_.window_start_periods);
  DahlRun& run = runs_[lane.point];
  run.final_state = state;
  run.whole = {(lane.before_window.friction_ratio + lane.window.friction_ratio) / duration,
               lane.before_window.friction_work + lane.window.friction_work};
  run.window = {lane.window.friction_ratio / window, lane.window.friction_work};
  end(lane, RunStatus::solved);
}

}  // namespace sonoglide::batch
