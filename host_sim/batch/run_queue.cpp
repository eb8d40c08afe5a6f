#include "host_sim/batch/run_queue.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::batch {
namespace {

constexpr std::uint32_t longest_stretch_periods = 64;
constexpr double softest_contact = 1e-9;
constexpr double stiffest_contact = 1e9;

/// Slides on for ever at phi = 1, with nothing to resolve.
constexpr LanePlant idling = {{0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, {0.0, 0.0, 1.0}}, 0.0, 0.5};

bool lies_within(double value, double lowest, double highest) {
  return lowest <= value && value <= highest;
}

bool suits_lanes(const DahlPlant& plant) {
  return std::abs(plant.drive_amplitude) < farthest && lies_within(plant.damping, 0.0, farthest) &&
         lies_within(plant.stiffness, 0.0, farthest) &&
         lies_within(plant.friction_force, 0.0, farthest) &&
         lies_within(plant.contact_stiffness, softest_contact, stiffest_contact) &&
         std::abs(plant.sliding_velocity) < farthest && std::abs(plant.vibration_sign) == 1.0 &&
         plant::is_finite(plant.initial) && std::abs(plant.initial.friction) <= 1.0;
}

LanePlant prepare(const DahlPlant& plant) {
  const double natural_frequency = std::sqrt(plant.stiffness);
  const double contact_frequency = std::sqrt(plant.friction_force * plant.contact_stiffness);
  return {plant, natural_frequency, 0.5 + natural_frequency + plant.damping + contact_frequency};
}

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
  const bool lost =
      !plant::is_finite(progress.state) ||
      std::abs(progress.state.displacement) + std::abs(progress.state.velocity) >= farthest;
  if (lost || progress.periods_left > 0.0) {
    end(lane, lost ? RunStatus::not_finite : RunStatus::too_many_steps);
    return false;
  }
  const bool in_window = lane.periods_done >= length_.window_start_periods;
  FrictionAverages& sums = in_window ? lane.window : lane.before_window;
  sums.friction_ratio += progress.integrals.friction_ratio;
  sums.friction_work += progress.integrals.friction_work;
  lane.periods_done += static_cast<std::uint32_t>(stretch_periods(at));
  if (lane.periods_done < length_.periods) {
    return true;
  }
  finish(lane, progress.state);
  return false;
}

double RunQueue::stretch_periods(std::size_t at) const {
  const Lane& lane = lanes_[at];
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
