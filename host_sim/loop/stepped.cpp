#include "host_sim/loop/stepped.hpp"

#include <cmath>
#include <optional>

#include "host_sim/configure/configuration_error.hpp"

namespace sonoglide::loop {
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
  if (kind != Kind::loop && scene.drive->bias_limit_N > 0.0) {
    throw ConfigurationError("drive.bias_limit_N",
                             "a plant or a controller alone has no bias force between the two; "
                             "allowed: 0, or the whole loop");
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

namespace {

scene::Scene without_end(scene::Scene scene) {
  scene.run.duration_s = endless_periods / scene.drive->frequency_Hz;
  return scene;
}

/// Whoever asks for energies lets a scene run.
Watch nobody() {
  Watch watch;
  watch.energies = false;
  return watch;
}

}  // namespace

SteppedScene::SteppedScene(const configure::Experiment& experiment, Kind kind)
    : scene_(without_end(experiment.plant)),
      carrier_changes_(scene_.carrier_changes()),
      watch_(nobody()),
      result_(begun_result(has_controller(kind) ? experiment.design : std::nullopt)),
      port_(result_.control ? make_control_port(scene_, result_.control->design) : nullptr),
      engine_(scene_, loop::has_plant(kind), port_.get(), watch_, result_) {
  if (has_plant()) {
    PlantPeriod before;
    before.end_velocity_m_per_s = engine_.plant()->sliding_velocity_m_per_s();
    before.vibration_m_per_s = 0.0;
    show_plant(before);
  }
  if (port_) {
    show_controller();
  }
}

CarrierClock SteppedScene::next_period(const Inputs& inputs) const {
  CarrierClock period = engine_.clock();
  if (carrier_changes_) {
    period.set_frequency_Hz(port_ ? engine_.control()->frequency_Hz() : inputs.drive_frequency_Hz);
  }
  return period;
}

void SteppedScene::advance(const Inputs& inputs) {
  engine_.set_frequency_Hz(next_period(inputs).frequency_Hz());
  const double amplitude_N =
      port_ ? engine_.control()->amplitude_N() : inputs.drive_force_amplitude_N;
  const double bias_N = port_ ? engine_.control()->bias_N() : 0.0;
  if (has_plant()) {
    engine_.set_load_force_N(inputs.load_force_N);
  }
  PlantPeriod period = has_plant() ? engine_.move(amplitude_N, bias_N) : engine_.begun(amplitude_N);
  if (has_plant()) {
    show_plant(period);
  } else {
    period.mean_friction_force_N = inputs.seen.mean_friction_force_N;
    period.end_velocity_m_per_s = inputs.seen.sliding_velocity_m_per_s;
    period.vibration_m_per_s = {inputs.seen.vibration_in_phase_m_per_s,
                                inputs.seen.vibration_quadrature_m_per_s};
  }
  if (port_ && inputs.target > 0.0) {
    engine_.control()->aim_at(inputs.target);
  }
  engine_.conclude(period);
  if (port_) {
    const std::uint8_t fault = controller_outputs_.answer.fault;
    show_controller();
    const std::uint8_t now = controller_outputs_.answer.fault;
    fault_began_ = now != 0 && now != fault;
  }
}

void SteppedScene::show_plant(const PlantPeriod& period) {
  plant_outputs_.mean_friction_force_N = period.mean_friction_force_N;
  plant_outputs_.sliding_velocity_m_per_s = period.end_velocity_m_per_s;
  if (scene_.demodulates()) {
    plant_outputs_.vibration_in_phase_m_per_s = period.vibration_m_per_s.real();
    plant_outputs_.vibration_quadrature_m_per_s = period.vibration_m_per_s.imag();
  }
  plant_outputs_.friction_ratio = std::isnan(period.friction_ratio) ? 0.0 : period.friction_ratio;
  plant_outputs_.resistance_N = std::isnan(period.friction_force_N) ? 0.0 : period.friction_force_N;
  const PlantState state = engine_.plant()->state();
  plant_outputs_.displacement_m = state.displacement_m;
  plant_outputs_.velocity_m_per_s = state.velocity_m_per_s;
  plant_outputs_.friction_force_N = state.friction_force_N;
  plant_outputs_.load_displacement_m = engine_.plant()->load_displacement_m();
  plant_outputs_.sliding_distance_m = period.end_distance_m;
}

void SteppedScene::show_controller() {
  const ControlRun& control = *engine_.control();
  controller_outputs_ = {control.amplitude_N(), control.frequency_Hz(), control.answer(),
                         control.trace_hash()};
}

void SteppedScene::copy_state(StateCopy& copy) {
  copy(plant_outputs_, controller_outputs_);
  engine_.copy_state(copy);
}

}  // namespace sonoglide::loop
