/// The conditions under which scenes use a key, with what is wrong where they do not hold.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>

#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/scene_file/key.hpp"

namespace sonoglide::scene_file::uses {

using scene::Scene;

inline bool is_closed(const Scene& scene) {
  return scene.controller.has_value();
}
inline bool is_open(const Scene& scene) {
  return !scene.controller;
}
inline bool has_drive(const Scene& scene) {
  return scene.drive.has_value();
}
inline bool has_load(const Scene& scene) {
  return scene.load.has_value();
}
inline bool has_transducer(const Scene& scene) {
  return scene.transducer.has_value();
}
inline bool has_no_transducer(const Scene& scene) {
  return !scene.transducer;
}
inline bool observes(const Scene& scene) {
  return scene.controller && scene.controller->vibration;
}
inline bool is_fed_forward(const Scene& scene) {
  return !observes(scene);
}
inline std::string with_mode(const Scene& scene) {
  return fmt::format("with controller.vibration = \"{}\"",
                     scene::name_of(scene::vibration_controls, *scene.controller->vibration));
}
inline bool holds_by(const Scene& scene, scene::VibrationControl control) {
  return scene.controller && scene.controller->vibration == control;
}

inline std::string not_at_resonance(const Scene& /*scene*/) {
  return "without controller.vibration = \"resonant\"";
}
inline std::string in_another_mode(const Scene& scene) {
  return observes(scene) ? with_mode(scene) : not_at_resonance(scene);
}

inline constexpr const char* unobserved = "without controller.vibration";

inline const Uses always;
inline const Uses closed_loop = {
    {"closed loop", is_closed, "in open loop, without a [controller] table"}};
/// Of a table.
inline const Uses a_drive = {{"[drive]", has_drive, "without a table [drive]"}};
/// Of a time in carrier periods.
inline const Uses a_period = {{"[drive]", has_drive,
                               "there is no period without a [drive] table; allowed: the time in s",
                               nullptr, "", true}};
/// Of a table.
inline const Uses no_load = {{"without [load]", [](const Scene& scene) { return !has_load(scene); },
                              "with a [load], whose velocity follows from what acts on it"}};
inline const Uses a_load_spring = {
    {"load.spring_N_per_m above 0",
     [](const Scene& scene) { return has_load(scene) && scene.load->spring_N_per_m > 0.0; },
     "without a load.spring_N_per_m above 0"}};
inline const Uses a_transducer = {{"with [transducer]", has_transducer, "without a [transducer]"}};
/// Of an amplitude: a force without a transducer, a voltage with one.
inline const Uses in_newtons = {
    {"without [transducer]", has_no_transducer, "",
     [](const Scene& scene) {
       return fmt::format("is a force, but with a [transducer] the drive is a voltage; allowed: {}",
                          scene.controller ? "max_voltage_amplitude_V" : "voltage_amplitude_V");
     },
     "", true}};
inline const Uses in_volts = {
    {"with [transducer]", has_transducer, "",
     [](const Scene& scene) {
       return fmt::format(
           "is a voltage, but without a [transducer] the drive is a force; allowed: {}",
           scene.controller ? "max_force_amplitude_N" : "force_amplitude_N");
     },
     "", true}};
inline const Uses no_transducer = {
    {"without [transducer]", has_no_transducer, "with a [transducer]"}};
inline const Uses given_start = {
    {"run.start = \"given\"",
     [](const Scene& scene) { return scene.run.start == scene::Start::given; },
     "with run.start = \"steady\"", nullptr, "run"}};
inline const Uses cosine_drive = {
    {"drive.waveform = \"cosine\"",
     [](const Scene& scene) { return scene.drive->waveform == scene::Waveform::cosine; }, "",
     [](const Scene& scene) {
       return fmt::format("with drive.waveform = \"{}\"",
                          scene::name_of(scene::waveforms, scene.drive->waveform));
     }}};
inline const Uses linear_interpolation = {
    {"drive.interpolation = \"linear\"",
     [](const Scene& scene) { return scene.drive->interpolation == scene::Interpolation::linear; },
     "without drive.interpolation = \"linear\""}};
/// An empty list switches the recording off in place: what it uses may stay.
inline const Uses recording = {
    {"run.record", [](const Scene& scene) { return !scene.run.record.empty(); }, ""}};
inline const Uses observed_vibration = {{"controller.vibration", observes, unobserved}};
inline const Uses no_observed_vibration = {{unobserved, is_fed_forward, "", with_mode}};
inline const Uses no_damped_vibration = {
    {"", [](const Scene& scene) { return !holds_by(scene, scene::VibrationControl::damped); }, "",
     with_mode, "controller"}};
inline const Uses no_resonance = {
    {"controller.vibration other than \"resonant\"",
     [](const Scene& scene) { return !holds_by(scene, scene::VibrationControl::resonant); }, "",
     with_mode, "controller"}};
inline const Uses robust_shaping = {
    {"controller.shaping = \"robust\"",
     [](const Scene& scene) { return scene.controller->shaping == scene::Shaping::robust; },
     "without controller.shaping = \"robust\""}};
inline const Uses force_sensor = {{"sensor.force = true",
                                   [](const Scene& scene) { return scene.sensor.force; },
                                   "with sensor.force = false", nullptr, "sensor"}};
/// Of a key without which there is no target: its error is told by the sensor's table.
inline const Uses needed_force_sensor = {{"sensor.force = true", is_closed, ""}};
inline const Uses ratio_target = {
    {"target_friction_ratio", [](const Scene& scene) { return !scene.controller->holds_force(); },
     "with target_friction_force_N, where feedback holds the force whatever the friction"}};
/// Of what needs times in which the target stands still.
inline const Uses steady_target = {{"",
                                    [](const Scene& scene) { return !scene.controller->texture; },
                                    "with target_texture, which changes all the time"}};
inline bool samples_force(const Scene& scene) {
  return scene.sensor.samples_per_period.has_value();
}
inline const Uses sampled_force = {
    {"sensor.samples_per_period", samples_force, "without sensor.samples_per_period"}};
inline const Uses mean_force = {
    {"", [](const Scene& scene) { return !samples_force(scene); },
     "with sensor.samples_per_period, where filter_Hz takes its place"}};
inline const Uses vibration_sensor = {
    {"sensor.vibration", [](const Scene& scene) { return scene.sensor.vibration.has_value(); }, "",
     [](const Scene& scene) {
       return std::string(observes(scene) ? "without sensor.vibration" : unobserved);
     }}};

inline Uses open_loop(std::string otherwise) {
  return {{"open loop", is_open, std::move(otherwise)}};
}
inline Uses resonance(std::string (*otherwise)(const Scene&)) {
  return {{"controller.vibration = \"resonant\"",
           [](const Scene& scene) { return holds_by(scene, scene::VibrationControl::resonant); },
           "", otherwise, "controller"}};
}
/// Not for the reference of keys, where another condition implies it.
inline Uses implied(Uses uses) {
  uses.front().text.clear();
  return uses;
}

inline bool has_friction(const scene::FrictionLaw& law) {
  return !scene::is<scene::laws::None>(law);
}
/// The laws for which it holds, in words.
template <class Condition>
std::string laws_where(const Condition& holds) {
  Words words;
  Words others;
  for (const scene::FrictionLaw& law : scene::every_law) {
    (holds(law) ? words : others).push_back(scene::name_of(law));
  }
  return others.size() == 1 ? fmt::format("every law but {}", others.front())
                            : fmt::format("law {}", fmt::join(words, ", "));
}
template <class Condition>
Uses law(const Condition& holds) {
  return {{laws_where(holds), [holds](const Scene& scene) { return holds(scene.friction.law); }, "",
           [](const Scene& scene) {
             return fmt::format("with friction.law = \"{}\"", scene::name_of(scene.friction.law));
           }}};
}

/// The methods for which it holds, in words.
template <class Condition>
std::string methods_where(const Condition& holds) {
  Words words;
  for (const auto& each : scene::solver_methods) {
    if (holds(each.value)) {
      words.push_back(each.name);
    }
  }
  return fmt::format("method {}", fmt::join(words, ", "));
}
template <class Condition>
Uses method(const Condition& holds) {
  return {{methods_where(holds), [holds](const Scene& scene) { return holds(scene.solver.method); },
           "",
           [](const Scene& scene) {
             return fmt::format("with solver.method = \"{}\"",
                                scene::name_of(scene::solver_methods, scene.solver.method));
           }}};
}

}  // namespace sonoglide::scene_file::uses
