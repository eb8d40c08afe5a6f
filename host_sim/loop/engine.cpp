#include "host_sim/loop/engine.hpp"

#include <complex>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::loop {
namespace {

scene::Scene without_end(scene::Scene scene) {
  scene.run.duration_s = endless_periods / scene.drive->frequency_Hz;
  return scene;
}

}  // namespace

void require_usable(const scene::Scene& scene, Kind kind) {
  using configure::ConfigurationError;
  if (!scene.drive) {
    throw ConfigurationError("drive.frequency_Hz",
                             "missing; allowed: a scene with a carrier, whose period is the step");
  }
  if (has_controller(kind) && !scene.controller) {
    throw ConfigurationError("controller",
                             "missing; allowed: a scene in closed loop, or the plant alone");
  }
}

void require_constant_carrier(const scene::Scene& scene) {
  using configure::ConfigurationError;
  if (!scene.drive->frequency_profile.empty()) {
    throw ConfigurationError("drive.frequency_profile",
                             "changes the carrier period, which is the step; allowed: one "
                             "frequency, drive.frequency_Hz");
  }
  if (scene.resonant()) {
    throw ConfigurationError("controller.vibration",
                             "\"resonant\" changes the carrier period, which is the step; allowed: "
                             "\"damped\", or no such key");
  }
}

Engine::Engine(const scene::Scene& scene, Kind kind)
    : scene_(without_end(scene)), carrier_changes_(scene_.carrier_changes()), clock_(scene_) {
  watch_.energies = false;
  if (has_plant(kind)) {
    plant_.emplace(scene_, clock_, watch_, result_);
    plant_outputs_.sliding_velocity_m_per_s = plant_->sliding_velocity_m_per_s();
    show_plant();
  }
  if (has_controller(kind)) {
    record_.design = configure::design_control(scene);
    port_ = make_control_port(scene_, record_.design);
    controller_.emplace(scene_, CarrierGrid(scene_), *port_, record_);
    show_controller();
  }
}

CarrierClock Engine::next_period(const Inputs& inputs) const {
  CarrierClock period = clock_;
  if (carrier_changes_) {
    period.set_frequency_Hz(controller_ ? controller_->frequency_Hz() : inputs.drive_frequency_Hz);
  }
  return period;
}

void Engine::advance(const Inputs& inputs) {
  clock_ = next_period(inputs);
  if (plant_) {
    advance_plant(controller_ ? controller_->amplitude_N() : inputs.drive_force_amplitude_N);
  }
  if (controller_) {
    advance_controller(plant_ ? plant_outputs_ : inputs.seen, inputs.target_friction_ratio);
  }
  clock_.next();
}

void Engine::advance_plant(double amplitude_N) {
  const EnergyBalance energy = plant_->advance(amplitude_N);
  plant_outputs_.mean_friction_force_N = energy.friction_impulse_N_s / energy.duration_s;
  plant_outputs_.sliding_velocity_m_per_s = plant_->sliding_velocity_m_per_s();
  if (scene_.demodulates()) {
    const std::complex<double> vibration = energy.vibration_m_per_s();
    plant_outputs_.vibration_in_phase_m_per_s = vibration.real();
    plant_outputs_.vibration_quadrature_m_per_s = vibration.imag();
  }
  const double undriven_N_s =
      configure::largest_friction_limit_N(scene_.friction) * energy.undriven_s;
  plant_outputs_.friction_ratio =
      undriven_N_s > 0.0 ? energy.resistance_impulse_N_s / undriven_N_s : 0.0;
  show_plant();
}

void Engine::advance_controller(const PlantOutputs& seen, double target) {
  if (target > 0.0) {
    controller_->aim_at(target);
  }
  const std::uint8_t fault = controller_outputs_.answer.fault;
  controller_->step(clock_.end_s(), seen.mean_friction_force_N, seen.sliding_velocity_m_per_s,
                    {seen.vibration_in_phase_m_per_s, seen.vibration_quadrature_m_per_s});
  show_controller();
  fault_began_ = controller_outputs_.answer.fault != 0 && controller_outputs_.answer.fault != fault;
}

void Engine::show_plant() {
  const PlantState state = plant_->state();
  plant_outputs_.displacement_m = state.displacement_m;
  plant_outputs_.velocity_m_per_s = state.velocity_m_per_s;
  plant_outputs_.friction_force_N = state.friction_force_N;
}

void Engine::show_controller() {
  controller_outputs_ = {controller_->amplitude_N(), controller_->frequency_Hz(),
                         controller_->answer(), controller_->trace_hash()};
}

void Engine::save(SnapshotWriter& state) const {
  state.put(clock_);
  state.put(plant_outputs_);
  state.put(controller_outputs_);
  if (plant_) {
    plant_->save(state);
  }
  if (controller_) {
    controller_->save(state);
  }
}

void Engine::restore(SnapshotReader& state) {
  state.get(clock_);
  state.get(plant_outputs_);
  state.get(controller_outputs_);
  if (plant_) {
    plant_->restore(state);
  }
  if (controller_) {
    controller_->restore(state);
  }
}

}  // namespace sonoglide::loop
