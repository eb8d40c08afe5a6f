#include "host_sim/loop/control_run.hpp"

#include <algorithm>

namespace sonoglide::loop {

std::vector<ScheduledTarget> target_schedule(const scene::Scene& scene, const CarrierGrid& grid) {
  std::vector<ScheduledTarget> schedule;
  for (const scene::TargetStep& step : scene.controller->target_friction_ratio) {
    // The sample of a period is taken at its end.
    const std::uint64_t period = std::max<std::uint64_t>(1, grid.at_or_after(step.time_s)) - 1;
    schedule.push_back({period, step.time_s, step.friction_ratio});
  }
  return schedule;
}

ControlRun::ControlRun(const scene::Scene& scene, const CarrierGrid& grid, ControlPort& port,
                       ControlRecord& record)
    : schedule_(target_schedule(scene, grid)),
      port_(port),
      record_(record),
      sensor_(scene.sensor, record.design.scales),
      actuator_(scene.drive->delay_periods, record.design.scales.drive_amplitude_N) {}

void ControlRun::label(Period& period) const {
  const Command& command = actuator_.in_force();
  period.target = command.target;
  period.state = command.state;
  period.limit = command.limit;
  period.settling = command.settling;
  period.commanded_ratio = command.commanded_ratio;
}

void ControlRun::step(double time_s, double mean_force_N, double sliding_velocity_m_per_s) {
  follow_target();
  const hal::Drive drive = port_.exchange(sensor_.sample(mean_force_N, sliding_velocity_m_per_s));
  actuator_.take(drive, target_);
  account_for(drive, time_s);
}

void ControlRun::finish() {
  record_.trace_hash = hash_.value();
  record_.signals = port_.signals();
}

void ControlRun::follow_target() {
  for (; next_step_ < schedule_.size() && schedule_[next_step_].period <= period_; ++next_step_) {
    target_ = schedule_[next_step_].friction_ratio;
    port_.set_target(target_);
  }
  ++period_;
}

void ControlRun::account_for(const hal::Drive& drive, double time_s) {
  const auto fault = static_cast<control::Fault>(drive.fault);
  if (fault != control::Fault::none && fault != fault_) {
    record_.faults.push_back({time_s, fault});
  }
  fault_ = fault;
  hash_.add(drive);
  ++record_.commands;
  const auto limit = static_cast<control::Limit>(drive.limit);
  record_.saturated_commands += limit == control::Limit::actuator ? 1 : 0;
}

}  // namespace sonoglide::loop
