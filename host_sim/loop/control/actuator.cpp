#include "host_sim/loop/control/actuator.hpp"

#include <cstddef>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::loop {

Actuator::Actuator(const scene::Scene& scene)
    : full_scale_N_(scene.max_drive_force_N()),
      step_N_(scene.amplitude_step_N()),
      bias_limit_N_(scene.drive->bias_limit_N),
      queue_(static_cast<std::size_t>(scene.drive->delay_periods) + 1) {}

void Actuator::take(const hal::Drive& drive, double target, std::int32_t frequency,
                    std::int32_t bias) {
  const double asked_N = numeric::from_code<double>(drive.amplitude) * full_scale_N_;
  queue_[first_] = {scene::nearest_multiple(asked_N, step_N_),
                    numeric::from_code<double>(bias) * bias_limit_N_,
                    frequency,
                    target,
                    2.0 * numeric::from_code<double>(drive.commanded_ratio),  // on base 2
                    static_cast<control::State>(drive.state),
                    static_cast<control::Limit>(drive.limit),
                    static_cast<control::Settling>(drive.settling)};
  first_ = first_ + 1 == queue_.size() ? 0 : first_ + 1;
}

void Actuator::hold() {
  const std::size_t size = queue_.size();
  queue_[first_] = queue_[(first_ + size - 1) % size];
  first_ = first_ + 1 == size ? 0 : first_ + 1;
}

void Actuator::copy_state(StateCopy& copy) {
  for (Command& command : queue_) {
    copy(command);
  }
  copy(first_);
}

}  // namespace sonoglide::loop
