#include "host_sim/loop/control_run.hpp"

namespace sonoglide::loop {

ControlRun::ControlRun(const scene::Scene& scene, const CarrierGrid& grid, ControlPort& port,
                       ControlRecord& record)
    : scene_(scene),
      grid_(grid),
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
  follow_target(time_s);
  const hal::Drive drive = port_.exchange(sensor_.sample(mean_force_N, sliding_velocity_m_per_s));
  actuator_.take(drive, target_);
  account_for(drive, time_s);
}

void ControlRun::finish() {
  record_.trace_hash = hash_.value();
  record_.signals = port_.signals();
}

void ControlRun::follow_target(double time_s) {
  const auto& steps = scene_.controller->target_friction_ratio;
  const double now_s = time_s + grid_.rounding_s(time_s);
  while (next_step_ < steps.size() && steps[next_step_].time_s <= now_s) {
    target_ = steps[next_step_++].friction_ratio;
    port_.set_target(target_);
  }
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
