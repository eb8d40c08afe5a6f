#include "host_sim/loop/control_run.hpp"

#include <algorithm>
#include <cmath>

namespace sonoglide::loop {

namespace {

/// Vibration read over the true one: a motional current is taken over the nominal force factor.
double vibration_gain(const scene::Scene& plant, const configure::ControlDesign& design) {
  return plant.sensor.vibration == scene::VibrationSensor::motional_current
             ? plant.transducer->force_factor_N_per_V / design.force_factor_N_per_V
             : 1.0;
}

std::optional<app::ElapsedPeriods> elapsed_of(const configure::ControlDesign& design) {
  const configure::ResonantDesign* const resonance = design.resonance();
  return resonance != nullptr ? std::optional(app::ElapsedPeriods(resonance->start_word))
                              : std::nullopt;
}

}  // namespace

std::vector<ScheduledTarget> target_schedule(const scene::Scene& scene, const CarrierGrid& grid) {
  std::vector<ScheduledTarget> schedule;
  for (const scene::TargetStep& step : scene.controller->targets()) {
    // The sample of a period is taken at its end.
    const std::uint64_t period = std::max<std::uint64_t>(1, grid.at_or_after(step.time_s)) - 1;
    const std::uint64_t place =
        period / static_cast<std::uint64_t>(scene.controller->every_periods);
    const double elapsed =
        std::ldexp(step.time_s / grid.period_s(), app::ElapsedPeriods::fraction_bits);
    schedule.push_back({scene.resonant() ? static_cast<std::uint64_t>(std::round(elapsed)) : place,
                        step.time_s, step.value});
  }
  return schedule;
}

ControlRun::ControlRun(const scene::Scene& scene, const CarrierGrid& grid, ControlPort& port,
                       ControlRecord& record)
    : schedule_(target_schedule(scene, grid)),
      texture_(scene.controller->texture),
      follows_texture_(texture_.has_value()),
      port_(port),
      record_(record),
      observes_vibration_(scene.sensor.vibration),
      sensor_(scene.sensor, record.design.scales, vibration_gain(scene, record.design)),
      actuator_(scene),
      every_periods_(scene.controller->every_periods),
      start_frequency_Hz_(scene.drive->frequency_Hz),
      clock_ratio_(scene.drive->frequency_Hz / record.design.carrier_Hz),
      nominal_friction_N_(record.design.friction_force * record.design.scales.force_N),
      elapsed_(elapsed_of(record.design)) {}

double ControlRun::frequency_Hz() const {
  const std::int32_t steps = actuator_.in_force().frequency;
  if (steps == 0) {
    return start_frequency_Hz_;
  }
  const configure::ResonantDesign& resonance = *record_.design.resonance();
  return clock_ratio_ * (resonance.step_Hz * (static_cast<double>(resonance.start_word) + steps));
}

void ControlRun::label(Period& period) const {
  const Command& command = actuator_.in_force();
  const bool of_force = record_.design.holds_force;
  period.target = follows_texture_
                      ? texture_->at(0.5 * (period.begin_distance_m + period.end_distance_m))
                      : command.target;
  period.target_ratio = of_force ? period.target / nominal_friction_N_ : period.target;
  period.state = command.state;
  period.limit = command.limit;
  period.settling = command.settling;
  period.commanded_ratio = command.commanded_ratio;
  period.bias_N = command.bias_N;
  const bool held = control::drives(command.state);
  if (observes_vibration_ && held && (of_force || period.target < 1.0)) {
    period.wanted_vibration_m_per_s =
        record_.design.vibration_map(nominal_friction_N_)
            .velocity_m_per_s(command.commanded_ratio, period.begin_velocity_m_per_s);
  }
}

void ControlRun::step(double time_s, const PeriodForce& force, double sliding_velocity_m_per_s,
                      std::complex<double> vibration_m_per_s, double mean_velocity_m_per_s) {
  if (++periods_ < every_periods_) {
    sensor_.pass(force);
    actuator_.hold();
    return;
  }
  periods_ = 0;
  follow_target();
  learn(force.mean_N);
  const bool biased = answers_with_bias();
  if (observes_vibration_ && biased) {
    take(port_.exchange_biased(sensor_.sample(force, sliding_velocity_m_per_s, vibration_m_per_s,
                                              mean_velocity_m_per_s)),
         time_s);
  } else if (observes_vibration_) {
    take(port_.exchange(sensor_.sample(force, sliding_velocity_m_per_s, vibration_m_per_s)),
         time_s);
  } else if (biased) {
    take(port_.exchange_biased(sensor_.sample(force, sliding_velocity_m_per_s)), time_s);
  } else {
    take(port_.exchange(sensor_.sample(force, sliding_velocity_m_per_s)), time_s);
  }
}

template <class Drive>
void ControlRun::take(const Drive& drive, double time_s) {
  actuator_.take(drive, target_);
  account_for(drive, time_s);
}

void ControlRun::aim_at(double target) {
  next_step_ = schedule_.size();
  follows_texture_ = false;
  target_ = target;
  port_.set_target(target_);
}

void ControlRun::copy_state(StateCopy& copy) {
  copy(hash_, answer_, next_step_, periods_, step_, nominal_friction_N_, elapsed_, target_,
       follows_texture_, fault_, record_.commands, record_.saturated_commands);
  sensor_.copy_state(copy);
  actuator_.copy_state(copy);
  port_.copy_state(copy);
}

void ControlRun::finish() {
  record_.trace_hash = hash_.value();
  record_.signals = port_.signals();
  const std::optional<FrictionBelief> own = port_.friction();
  if (own && record_.faults.empty()) {  // what a fault came from may have been learnt
    const configure::ControlDesign& design = record_.design;
    record_.friction = {own->friction_force.scaled(design.scales.force_N),
                        own->contact_stiffness.scaled(design.contact_stiffness_N_per_m()),
                        own->gain};
  }
}

/// The friction force of the last undriven period of a calibration, or of a pause.
void ControlRun::learn(double mean_force_N) {
  const Command& command = actuator_.in_force();
  const bool learning =
      command.state == control::State::calibrating || command.state == control::State::relearning;
  if (learning && command.amplitude_N == 0.0 && mean_force_N != 0.0) {
    nominal_friction_N_ = std::abs(mean_force_N);
  }
}

void ControlRun::follow_target() {
  if (elapsed_) {
    elapsed_->add(actuator_.in_force().frequency);
  }
  const std::uint64_t now = elapsed_ ? elapsed_->value() : step_;
  for (; next_step_ < schedule_.size() && schedule_[next_step_].place <= now; ++next_step_) {
    target_ = schedule_[next_step_].target;
    port_.set_target(target_);
  }
  ++step_;
}

template <class Drive>
void ControlRun::account_for(const Drive& drive, double time_s) {
  const auto fault = static_cast<control::Fault>(drive.fault);
  if (fault != control::Fault::none && fault != fault_) {
    record_.faults.push_back({time_s, fault});
  }
  fault_ = fault;
  answer_ = static_cast<const hal::Drive&>(drive);
  hash_.add(drive);
  ++record_.commands;
  const auto limit = static_cast<control::Limit>(drive.limit);
  const bool at_most = limit == control::Limit::actuator || limit == control::Limit::voltage ||
                       limit == control::Limit::current;
  record_.saturated_commands += at_most ? 1 : 0;
}

}  // namespace sonoglide::loop
