#include "host_sim/loop/actuator.hpp"

#include <cstddef>

namespace sonoglide::loop {

Actuator::Actuator(int delay_periods, double full_scale_N)
    : full_scale_N_(full_scale_N), queue_(static_cast<std::size_t>(delay_periods) + 1) {}

void Actuator::take(const hal::Drive& drive, double target) {
  constexpr double unit = 1.0 / 2147483648.0;  // of a code, 2^-31
  queue_.pop_front();
  queue_.push_back({drive.amplitude * unit * full_scale_N_, target,
                    2.0 * unit * drive.commanded_ratio,  // on base 2
                    static_cast<control::State>(drive.state),
                    static_cast<control::Limit>(drive.limit),
                    static_cast<control::Settling>(drive.settling)});
}

}  // namespace sonoglide::loop
