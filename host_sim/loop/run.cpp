#include "host_sim/loop/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/carrier_clock.hpp"
#include "host_sim/loop/control_run.hpp"
#include "host_sim/loop/plant_run.hpp"

namespace sonoglide::loop {
namespace {

/// Progress is told this often, and once in so many carrier periods of a long run.
constexpr std::uint64_t progress_calls = 500;
constexpr std::uint64_t most_periods_untold = 10000;

std::optional<ControlRun> make_control(const scene::Scene& scene, ControlPort* controller,
                                       RunResult& result) {
  if (controller == nullptr) {
    return std::nullopt;
  }
  return std::optional<ControlRun>(std::in_place, scene, CarrierGrid(scene), *controller,
                                   *result.control);
}

class Simulation {
 public:
  /// @param controller  null in open loop
  /// @param result      with the record of a closed loop, of which the design is filled in
  Simulation(const scene::Scene& scene, ControlPort* controller, const Watch& watch,
             RunResult& result)
      : scene_(scene),
        watch_(watch),
        clock_(scene),
        plant_(scene, clock_, watch, result),
        control_(make_control(scene, controller, result)),
        frequency_changes_(scene.drive && !scene.drive->frequency_profile.empty()),
        friction_N_(configure::largest_friction_limit_N(scene.friction)),
        open_loop_amplitude_N_(scene.drive ? scene.drive->force_amplitude_N : 0.0) {}

  void carry_out() {
    const std::uint64_t tell_every =
        std::min(CarrierGrid(scene_).count() / progress_calls + 1, most_periods_untold);
    for (std::uint64_t k = 0; !clock_.over(); ++k, clock_.next()) {
      if (watch_.progress && k % tell_every == 0) {
        watch_.progress(clock_.begin_s() / scene_.run.duration_s);
      }
      advance();
    }
    plant_.finish();
    if (control_) {
      control_->finish();
    }
  }

 private:
  void advance() {
    if (control_ && control_->leads_frequency()) {
      clock_.set_frequency_Hz(control_->frequency_Hz());
    } else if (frequency_changes_) {
      clock_.set_frequency_Hz(configure::carrier_frequency_Hz(*scene_.drive, clock_.begin_s()));
    }
    const double begin_s = clock_.begin_s();
    const double end_s = clock_.end_s();
    const double begin_velocity_m_per_s = plant_.sliding_velocity_m_per_s();
    const double amplitude_N = control_ ? control_->amplitude_N() : open_loop_amplitude_N_;
    const EnergyBalance energy = plant_.advance(amplitude_N);
    const double end_velocity_m_per_s = plant_.sliding_velocity_m_per_s();
    if (!watch_.periods.empty()) {
      show({begin_s, end_s, friction_ratio(energy), begin_velocity_m_per_s, end_velocity_m_per_s,
            amplitude_N, clock_.frequency_Hz(), clock_.is_whole(), vibration_m_per_s(energy),
            energy.open_s / energy.duration_s, natural_Hz(0.5 * (begin_s + end_s))});
    }
    if (control_ && clock_.is_whole()) {
      control_->step(end_s, energy.friction_impulse_N_s / energy.duration_s, end_velocity_m_per_s,
                     vibration_m_per_s(energy));
    }
  }

  /// A mean over part of a carrier period is no friction ratio; a run without a drive has parts alone.
  double friction_ratio(const EnergyBalance& energy) const {
    const double undriven_N_s = friction_N_ * energy.undriven_s;
    const bool mean = clock_.is_whole() || clock_.frequency_Hz() == 0.0;
    return mean && undriven_N_s > 0.0 ? energy.resistance_impulse_N_s / undriven_N_s
                                      : Period::undefined;
  }

  /// Of a period that is cut short there is no fundamental.
  std::complex<double> vibration_m_per_s(const EnergyBalance& energy) const {
    return scene_.demodulates() && clock_.is_whole() ? energy.vibration_m_per_s()
                                                     : Period::undefined;
  }

  double natural_Hz(double time_s) const {
    const double stiffness_N_per_m = scene_.plant.stiffness_profile.empty()
                                         ? scene_.plant.stiffness_N_per_m
                                         : scene::value_at(scene_.plant.stiffness_profile, time_s);
    return std::sqrt(stiffness_N_per_m / scene_.plant.mass_kg) / numeric::two_pi;
  }

  void show(Period period) const {
    if (control_) {
      control_->label(period);
    }
    for (PeriodSink* sink : watch_.periods) {
      sink->take(period);
    }
  }

  const scene::Scene& scene_;
  const Watch& watch_;
  CarrierClock clock_;
  PlantRun plant_;
  std::optional<ControlRun> control_;
  bool frequency_changes_;
  double friction_N_;
  double open_loop_amplitude_N_;
};

RunResult simulate(const scene::Scene& scene, ControlPort* controller, const Watch& watch,
                   RunResult result) {
  const auto begin = std::chrono::steady_clock::now();
  Simulation(scene, controller, watch, result).carry_out();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  result.wall_s = wall.count();
  return result;
}

}  // namespace

RunResult run(const scene::Scene& scene, const Watch& watch) {
  return run(scene, configure::design_if_closed(scene), watch);
}

RunResult run(const scene::Scene& scene, const std::optional<configure::ControlDesign>& design,
              const Watch& watch) {
  if (!design) {
    return simulate(scene, nullptr, watch, {});
  }
  const auto controller = make_control_port(scene, *design);
  return run(scene, *design, *controller, watch);
}

RunResult run(const scene::Scene& scene, ControlPort& controller, const Watch& watch) {
  return run(scene, configure::design_control(scene), controller, watch);
}

RunResult run(const scene::Scene& scene, const configure::ControlDesign& design,
              ControlPort& controller, const Watch& watch) {
  RunResult result;
  result.control.emplace();
  result.control->design = design;
  return simulate(scene, &controller, watch, std::move(result));
}

}  // namespace sonoglide::loop
