#include "host_sim/batch/driven_queue.hpp"

#include <optional>

#include "firmware/numeric/turn.hpp"

namespace sonoglide::batch {

LanePlant DrivenQueue::next(std::size_t lane) {
  for (; next_point_ < count_; ++next_point_) {
    statuses_[next_point_] = RunStatus::outside_range;
    const DahlPlant& plant = plants_[next_point_];
    if (suits_lanes(plant)) {
      lanes_[lane] = {false, next_point_++, plant.drive_amplitude};
      ++busy_;
      return prepare(plant);
    }
  }
  return idling;
}

LanePlant DrivenQueue::give_up(std::size_t lane) {
  end(lanes_[lane], RunStatus::undecided_reversal);
  return next(lane);
}

bool DrivenQueue::goes_on(std::size_t at, const Progress& progress) {
  Lane& lane = lanes_[at];
  if (lane.idle) {
    return false;
  }
  const RunStatus status = status_of(progress);
  if (status != RunStatus::solved) {
    end(lane, status);
    return false;
  }
  const std::optional<double> amplitude =
      source_.next_amplitude(lane.point, progress.integrals.friction_ratio / numeric::two_pi);
  if (!amplitude) {
    end(lane, RunStatus::solved);
    return false;
  }
  lane.drive_amplitude = *amplitude;
  return true;
}

void DrivenQueue::end(Lane& lane, RunStatus status) {
  statuses_[lane.point] = status;
  lane.idle = true;
  --busy_;
}

}  // namespace sonoglide::batch
