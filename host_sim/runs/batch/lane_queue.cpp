#include "host_sim/runs/batch/lane_queue.hpp"

#include <cmath>

#include "firmware/numeric/turn.hpp"

namespace sonoglide::batch {
namespace {

constexpr double softest_contact = 1e-9;
constexpr double stiffest_contact = 1e9;

bool lies_within(double value, double lowest, double highest) {
  return lowest <= value && value <= highest;
}

/// Every parameter is one that the lanes are made for.
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

/// `solved` where the lane has come to the end of its stretch.
RunStatus status_of(const Progress& progress) {
  if (!plant::is_finite(progress.state) ||
      std::abs(progress.state.displacement) + std::abs(progress.state.velocity) >= farthest) {
    return RunStatus::not_finite;
  }
  return progress.periods_left > 0.0 ? RunStatus::too_many_steps : RunStatus::solved;
}

}  // namespace

double bound_of(const DriveAmplitude& drive) {
  return std::fmax(std::abs(drive.at_zero),
                   std::abs(drive.at_zero + numeric::two_pi * drive.slope)) +
         2.0 * std::abs(drive.slope);
}

LanePlant LaneQueue::next(std::size_t lane) {
  while (next_point_ < count_) {
    const std::size_t point = next_point_++;
    set_status(point, RunStatus::outside_range);
    if (suits_lanes(plants_[point])) {
      lanes_[lane] = {false, point, first_stretch(lane, point)};
      ++busy_;
      return prepare(plants_[point]);
    }
  }
  return idling;
}

LanePlant LaneQueue::give_up(std::size_t lane) {
  end(lanes_[lane], RunStatus::undecided_reversal);
  return next(lane);
}

bool LaneQueue::goes_on(std::size_t at, const Progress& progress) {
  Lane& lane = lanes_[at];
  if (lane.idle) {
    return false;
  }
  const RunStatus status = status_of(progress);
  const std::optional<LaneStretch> stretch =
      status == RunStatus::solved ? next_stretch(at, lane.point, progress) : std::nullopt;
  if (!stretch) {
    end(lane, status);
    return false;
  }
  lane.stretch = *stretch;
  return true;
}

void LaneQueue::end(Lane& lane, RunStatus status) {
  set_status(lane.point, status);
  lane = Lane();
  --busy_;
}

}  // namespace sonoglide::batch
