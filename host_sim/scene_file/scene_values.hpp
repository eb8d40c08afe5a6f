/// Which value of a scene each key holds, and when: told once, for the reader and for the echo.
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "host_sim/configure/solver_methods.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/keys.hpp"

namespace sonoglide::scene_file {

/// A number that holds throughout, or in its place a profile and its value at 0 s.
struct Level {
  std::string_view key;
  std::string_view profile_key;
  double& value;
  scene::TimedProfile& profile;
};

/// Whether a profile in place of a value may hold a 0, as the value may.
enum class ZeroIn { profile, value_only };

// Each visitor takes a `Keys` and calls, in the order of the list of keys:
//   keys.value(key, value)           a number; absent, what the list of keys says
//   keys.value(key, value, absent)   the same; absent, a number that follows from other keys
//   keys.value_in(key, value, range) the same in a range that follows from other keys
//   keys.value_or_0(key, value)      a number that is 0 where the key is absent
//   keys.word(key, value, names)     one of the named values
//   keys.optional_word(key, value, names)  the same, or none
//   keys.truth(key, value)           true or false
//   keys.range(key, range)           two frequencies, or none
//   keys.words(key, values, names)   a list of them; empty where absent
//   keys.one_of(key, value, allowed) one of a few integers
//   keys.time(key, periods_key, value, drive)  in seconds, or under the other key in periods
//   keys.level(level, zero, absent)   required where `absent` is nullopt
//   keys.profile(key, profile)       empty where absent
//   keys.speed(key, profile_key, points)  one speed, or its profile in place of it
//   keys.targets(key, steps)
// and, of a friction law, what scene::laws::None lists.

template <class Keys>
void visit_plant(Keys& keys, scene::Plant& plant, scene::Start start) {
  keys.value("mass_kg", plant.mass_kg);
  keys.level(Level{"stiffness_N_per_m", "stiffness_profile", plant.stiffness_N_per_m,
                   plant.stiffness_profile},
             ZeroIn::profile, std::nullopt);
  keys.value("damping_N_s_per_m", plant.damping_N_s_per_m);
  if (start == scene::Start::given) {
    keys.value("initial_displacement_m", plant.initial_displacement_m);
    keys.value("initial_velocity_m_per_s", plant.initial_velocity_m_per_s);
  }
}

/// With the largest coefficient to come and with the smallest: a law's own keys suit both.
inline std::vector<scene::ContactValues> extreme_contacts(const scene::Friction& friction) {
  const scene::ContactValues& held = friction;
  if (friction.coefficient_profile.empty()) {
    return {held};
  }
  scene::ContactValues largest = held;
  scene::ContactValues smallest = held;
  largest.coefficient = scene::largest_value(friction.coefficient_profile);
  smallest.coefficient = scene::smallest_value(friction.coefficient_profile);
  return {largest, smallest};
}

template <class Keys>
void visit_friction(Keys& keys, scene::Friction& friction, const scene::Plant& plant,
                    scene::Start start) {
  keys.word("law", friction.law, scene::friction_laws);
  if (scene::is<scene::laws::None>(friction.law)) {
    return;
  }
  const ZeroIn zero = scene::is_bounded(friction.law) ? ZeroIn::profile : ZeroIn::value_only;
  keys.level(Level{"coefficient", "coefficient_profile", friction.coefficient,
                   friction.coefficient_profile},
             zero, std::nullopt);
  keys.level(Level{"normal_force_N", "normal_force_profile_N", friction.normal_force_N,
                   friction.normal_force_profile_N},
             zero, plant.mass_kg * standard_gravity_m_per_s2);
  if (scene::is_elastic(friction.law)) {
    keys.value("contact_stiffness_N_per_m", friction.contact_stiffness_N_per_m);
    if (start == scene::Start::given) {
      const double limit_N = friction.limit_N();
      keys.value_in("initial_force_N", friction.initial_force_N, {-limit_N, limit_N, "N"});
    }
  }
  for (const scene::ContactValues& contact : extreme_contacts(friction)) {
    std::visit([&](auto& law) { law.visit_keys(keys, contact); }, friction.law);
  }
  if (scene::vibrates_along(friction.law)) {
    keys.word("sign_convention", friction.sign_convention, scene::sign_conventions);
  }
}

template <class Keys>
void visit_sliding(Keys& keys, scene::Sliding& sliding) {
  keys.speed("velocity_m_per_s", "profile", sliding.profile);
}

template <class Keys>
void visit_transducer(Keys& keys, scene::Transducer& transducer) {
  keys.value("force_factor_N_per_V", transducer.force_factor_N_per_V);
  keys.value("clamped_capacitance_F", transducer.clamped_capacitance_F);
  keys.value("loss_tangent", transducer.loss_tangent);
}

template <class Keys>
void visit_open_loop_drive(Keys& keys, scene::Drive& drive, bool in_volts) {
  keys.profile("frequency_profile", drive.frequency_profile);
  keys.value_or_0("frequency_resolution_Hz", drive.frequency_resolution_Hz);
  if (in_volts) {
    keys.value("voltage_amplitude_V", drive.voltage_amplitude_V);
  } else {
    keys.value("force_amplitude_N", drive.force_amplitude_N);
  }
  keys.word("waveform", drive.waveform, scene::waveforms);
}

template <class Keys>
void visit_closed_loop_drive(Keys& keys, scene::Drive& drive, bool in_volts) {
  keys.value_or_0("frequency_resolution_Hz", drive.frequency_resolution_Hz);
  keys.word("waveform", drive.waveform, scene::waveforms);
  if (in_volts) {
    keys.value("max_voltage_amplitude_V", drive.max_voltage_amplitude_V);
    keys.value("max_current_amplitude_A", drive.max_current_amplitude_A);
  } else {
    keys.value("max_force_amplitude_N", drive.max_force_amplitude_N);
    keys.value("max_force_slew_N_per_s", drive.max_force_slew_N_per_s);
  }
  keys.value("delay_periods", drive.delay_periods);
}

/// @param in_volts  with a transducer
template <class Keys>
void visit_drive(Keys& keys, scene::Drive& drive, bool closed_loop, bool in_volts) {
  keys.value("frequency_Hz", drive.frequency_Hz);
  if (closed_loop) {
    visit_closed_loop_drive(keys, drive, in_volts);
  } else {
    visit_open_loop_drive(keys, drive, in_volts);
  }
}

template <class Described, class Keys>
void visit_accuracy(Keys& keys, scene::Solver& solver) {
  if constexpr (Described::adaptive) {
    keys.value("tolerance", solver.tolerance, Described::default_tolerance);
    if constexpr (Described::takes_order) {
      keys.one_of("order", solver.order, Described::orders);
    }
    if constexpr (Described::takes_step) {
      keys.value_or_0("step_s", solver.step_s);
    }
  } else {
    keys.value("step_s", solver.step_s);
  }
}

template <class Keys>
void visit_solver(Keys& keys, scene::Solver& solver) {
  keys.word("method", solver.method, configure::solver_methods);
  configure::for_each_solver([&](auto described, scene::SolverMethod method) {
    if (method == solver.method) {
      visit_accuracy<decltype(described)>(keys, solver);
    }
  });
}

template <class Keys>
void visit_run(Keys& keys, scene::Run& run, const std::optional<scene::Drive>& drive,
               bool closed_loop) {
  keys.time("duration_s", "duration_periods", run.duration_s, drive);
  keys.time("window_start_s", "window_start_periods", run.window_start_s, drive);
  if (closed_loop) {
    keys.value("settling_band", run.settling_band);
  } else {
    keys.word("start", run.start, scene::starts);
  }
  keys.words("record", run.record, scene::channels);
  if (!run.record.empty()) {
    keys.value("record_interval_s", run.record_interval_s);
  }
}

/// @param force  there is a force sensor
template <class Keys>
void visit_controller(Keys& keys, scene::Controller& controller, bool force) {
  keys.word("arithmetic", controller.arithmetic, scene::arithmetics);
  keys.optional_word("vibration", controller.vibration, scene::vibration_controls);
  if (controller.vibration == scene::VibrationControl::resonant) {
    keys.range("frequency_range_Hz", controller.frequency_range_Hz);
  }
  keys.targets("target_friction_ratio", controller.target_friction_ratio);
  if (force) {
    keys.value("calibration_s", controller.calibration_s, 0.0);
  }
  if (!controller.vibration) {
    keys.word("shaping", controller.shaping, scene::shapings);
    if (controller.shaping == scene::Shaping::robust) {
      keys.value("shaping_range", controller.shaping_range);
    }
  }
  keys.value("speed_floor_m_per_s", controller.speed_floor_m_per_s);
  keys.value("standstill_hold_s", controller.standstill_hold_s);
  if (force) {
    keys.value("relearn_every_s", controller.relearn_every_s);
    keys.value("mismatch_warning", controller.mismatch_warning);
  }
}

template <class Keys>
void visit_force_sensor(Keys& keys, scene::Sensor& sensor, double full_scale_N) {
  keys.value("adc_bits", sensor.adc_bits);
  keys.value("force_full_scale_N", sensor.force_full_scale_N, full_scale_N);
  keys.value("force_noise_N", sensor.force_noise_N);
  keys.value("force_bandwidth_Hz", sensor.force_bandwidth_Hz);
  keys.value("delay_periods", sensor.delay_periods);
  keys.value("force_offset_N", sensor.force_offset_N);
  keys.value("force_gain", sensor.force_gain);
}

/// @param full_scale_N  of the force, where the scene does not say
/// @param holds         the controller holds the vibration
template <class Keys>
void visit_sensor(Keys& keys, scene::Sensor& sensor, double full_scale_N, bool holds) {
  if (holds) {
    keys.truth("force", sensor.force);
  }
  if (sensor.force) {
    visit_force_sensor(keys, sensor, full_scale_N);
  }
  keys.value("velocity_offset_m_per_s", sensor.velocity_offset_m_per_s);
  keys.value("velocity_gain", sensor.velocity_gain);
  keys.value("seed", sensor.seed);
  if (holds) {
    keys.optional_word("vibration", sensor.vibration, scene::vibration_sensors);
  }
  if (sensor.vibration) {
    keys.value("vibration_bits", sensor.vibration_bits);
    keys.value("vibration_noise_m_per_s", sensor.vibration_noise_m_per_s);
    keys.value("vibration_full_scale_m_per_s", sensor.vibration_full_scale_m_per_s);
  }
}

/// @param holds     the controller holds the vibration
/// @param in_volts  there is a transducer
template <class Keys>
void visit_model_error(Keys& keys, scene::ModelError& model_error, const scene::FrictionLaw& law,
                       bool holds, bool in_volts) {
  keys.value("mass", model_error.mass);
  keys.value("stiffness", model_error.stiffness);
  keys.value("coefficient", model_error.coefficient);
  if (scene::is_elastic(law)) {
    keys.value("contact_stiffness", model_error.contact_stiffness);
  }
  if (holds && in_volts) {
    keys.value("force_factor", model_error.force_factor);
  }
  if (holds) {
    keys.value("damping", model_error.damping);
  }
}

}  // namespace sonoglide::scene_file
