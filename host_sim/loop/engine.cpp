#include "host_sim/loop/engine.hpp"

#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::loop {
RunResult begun_result(const std::optional<configure::ControlDesign>& design) {
  RunResult result;
  if (design) {
    result.control.emplace();
    result.control->design = *design;
  }
  return result;
}

Engine::Engine(const scene::Scene& scene, bool has_plant, ControlPort* controller,
               const Watch& watch, RunResult& result)
    : scene_(scene),
      watch_(watch),
      clock_(scene),
      friction_N_(scene.friction.largest_limit_N()),
      constant_natural_Hz_(scene.plant.natural_Hz()) {
  if (has_plant) {
    plant_.emplace(scene, clock_, watch, result);
  }
  if (controller != nullptr) {
    control_.emplace(scene, CarrierGrid(scene), *controller, *result.control);
  }
}

PlantPeriod Engine::begun(double amplitude_N) const {
  PlantPeriod period;
  period.begin_s = clock_.begin_s();
  period.end_s = clock_.end_s();
  period.drive_amplitude_N = amplitude_N;
  period.frequency_Hz = clock_.frequency_Hz();
  period.whole = clock_.is_whole();
  period.natural_Hz = natural_Hz(0.5 * (period.begin_s + period.end_s));
  return period;
}

PlantPeriod Engine::move(double amplitude_N, double bias_N) {
  PlantPeriod period = begun(amplitude_N);
  period.begin_velocity_m_per_s = plant_->sliding_velocity_m_per_s();
  const bool biased = control_ && control_->answers_with_bias();
  const double begin_m = biased ? plant_->state().displacement_m : 0.0;
  const EnergyBalance energy = plant_->advance(amplitude_N, bias_N);
  period.end_velocity_m_per_s = plant_->sliding_velocity_m_per_s();
  pass_distance(period);
  period.mean_friction_force_N = energy.friction_impulse_N_s / energy.duration_s;
  // A mean over part of a carrier period is no friction ratio; a run without a drive has parts alone.
  const double undriven_N_s = friction_N_ * energy.undriven_s;
  if ((period.whole || period.frequency_Hz == 0.0) && undriven_N_s > 0.0) {
    period.friction_ratio = energy.resistance_impulse_N_s / undriven_N_s;
    period.friction_force_N = energy.resistance_impulse_N_s / energy.duration_s;
  }
  // Of a period that is cut short there is no fundamental.
  if (scene_.demodulates() && period.whole) {
    period.vibration_m_per_s = energy.vibration_m_per_s();
    if (scene_.transducer) {
      period.current_A = current_A(*scene_.transducer, plant_->drive(), period.frequency_Hz,
                                   period.vibration_m_per_s);
    }
  }
  if (biased) {
    period.mean_velocity_m_per_s = (plant_->state().displacement_m - begin_m) / energy.duration_s;
  }
  period.open_fraction = energy.open_s / energy.duration_s;
  return period;
}

void Engine::conclude(PlantPeriod& period) {
  if (!plant_) {
    pass_distance(period);
  }
  if (control_ && !watch_.periods.empty()) {
    control_->label(period);
  }
  for (PeriodSink* sink : watch_.periods) {
    sink->take(period);
  }
  if (control_ && period.whole) {
    const double mean_N = period.mean_friction_force_N;
    control_->step(
        period.end_s, plant_ ? PeriodForce(mean_N, plant_->force_samples_N()) : PeriodForce(mean_N),
        period.end_velocity_m_per_s, period.vibration_m_per_s, period.mean_velocity_m_per_s);
  }
  clock_.next();
}

/// A prescribed velocity changes linearly, but for where two of its pieces meet.
void Engine::pass_distance(PlantPeriod& period) {
  period.begin_distance_m = distance_m_;
  distance_m_ =
      scene_.load && plant_
          ? plant_->load_displacement_m()
          : distance_m_ + 0.5 * (period.begin_velocity_m_per_s + period.end_velocity_m_per_s) *
                              (period.end_s - period.begin_s);
  period.end_distance_m = distance_m_;
}

double Engine::natural_Hz(double time_s) const {
  const scene::TimedProfile& profile = scene_.plant.stiffness_profile;
  return profile.empty()
             ? constant_natural_Hz_
             : scene::natural_Hz(scene::value_at(profile, time_s), scene_.plant.mass_kg);
}

void Engine::finish() {
  if (plant_) {
    plant_->finish();
  }
  if (control_) {
    control_->finish();
  }
}

void Engine::copy_state(StateCopy& copy) {
  copy(clock_, distance_m_);
  if (plant_) {
    plant_->copy_state(copy);
  }
  if (control_) {
    control_->copy_state(copy);
  }
}

}  // namespace sonoglide::loop
