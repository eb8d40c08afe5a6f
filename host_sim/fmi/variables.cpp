#include "host_sim/fmi/variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::fmi {
namespace {

struct PlantSignal {
  const char* name;
  const char* unit;
  const char* description;
  double PlantOutputs::*member;
  Value (*read)(const SteppedScene&);
};

template <double PlantOutputs::*Member>
Value plant_output(const SteppedScene& engine) {
  return engine.plant().*Member;
}

template <double PlantOutputs::*Member>
constexpr PlantSignal signal(const char* name, const char* unit, const char* description) {
  return {name, unit, description, Member, plant_output<Member>};
}

/// What goes from the plant to the controller.
constexpr std::array measured = {
    signal<&PlantOutputs::mean_friction_force_N>("mean_friction_force_N", "N",
                                                 "Friction force, mean over the carrier period"),
    signal<&PlantOutputs::sliding_velocity_m_per_s>(
        "sliding_velocity_m_per_s", "m/s", "Sliding velocity at the end of the carrier period")};
/// Of a scene in which the vibration is demodulated.
constexpr std::array demodulated = {
    signal<&PlantOutputs::vibration_in_phase_m_per_s>(
        "vibration_in_phase_m_per_s", "m/s",
        "Vibration velocity in phase with the drive, mean over the carrier period"),
    signal<&PlantOutputs::vibration_quadrature_m_per_s>(
        "vibration_quadrature_m_per_s", "m/s",
        "Vibration velocity in quadrature, mean over the carrier period")};
constexpr std::array series = {
    signal<&PlantOutputs::friction_ratio>(
        "friction_ratio", "1", "Friction ratio of the carrier period; 0 without friction"),
    signal<&PlantOutputs::displacement_m>("displacement_m", "m",
                                          "Displacement at the end of the carrier period"),
    signal<&PlantOutputs::velocity_m_per_s>("velocity_m_per_s", "m/s",
                                            "Velocity at the end of the carrier period"),
    signal<&PlantOutputs::friction_force_N>("friction_force_N", "N",
                                            "Friction force at the end of the carrier period")};

/// Of a scene with a load.
constexpr std::array of_load = {signal<&PlantOutputs::load_displacement_m>(
    "load_displacement_m", "m", "Displacement of the load at the end of the carrier period")};

class List {
 public:
  List() { add({"time", Role::time, "s", "Simulation time", 0.0}); }

  void add(Variable variable) { variables_.push_back(std::move(variable)); }

  template <std::size_t Count>
  void outputs(const std::array<PlantSignal, Count>& signals) {
    for (const PlantSignal& each : signals) {
      output(each.name, each.unit, each.description, 0.0, each.read);
    }
  }
  template <std::size_t Count>
  void inputs(const std::array<PlantSignal, Count>& signals) {
    for (const PlantSignal& each : signals) {
      Variable variable{each.name, Role::input, each.unit, each.description, 0.0};
      variable.seen = each.member;
      add(variable);
    }
  }
  void input(const char* name, const char* unit, const char* description, double start,
             double Inputs::*member) {
    Variable variable{name, Role::input, unit, description, start};
    variable.input = member;
    add(variable);
  }
  void output(const char* name, const char* unit, const char* description, const Value& type,
              Value (*read)(const SteppedScene&)) {
    Variable variable{name, Role::output, unit, description, type};
    variable.output = read;
    add(variable);
  }

  std::vector<Variable> take() { return std::move(variables_); }

 private:
  std::vector<Variable> variables_;
};

constexpr double whole_code = 0x1p-31;

void add_answer(List& list, scene::Arithmetic arithmetic) {
  if (arithmetic == scene::Arithmetic::float32) {
    list.output("drive_amplitude", "1", "Last answer: drive amplitude, of the largest", 0.0F,
                [](const SteppedScene& engine) -> Value {
                  return static_cast<float>(engine.controller().answer.amplitude * whole_code);
                });
    list.output(
        "commanded_friction_ratio", "1",
        "Last answer: friction ratio, target and feedback together", 0.0F,
        [](const SteppedScene& engine) -> Value {
          return static_cast<float>(engine.controller().answer.commanded_ratio * 2.0 * whole_code);
        });
  }
  list.output("drive_amplitude_code", "", "Last answer: drive amplitude; 2^31 is the largest",
              std::int32_t{}, [](const SteppedScene& engine) -> Value {
                return engine.controller().answer.amplitude;
              });
  list.output("commanded_ratio_code", "",
              "Last answer: friction ratio, target and feedback together; 2^31 is a ratio of 2",
              std::int32_t{}, [](const SteppedScene& engine) -> Value {
                return engine.controller().answer.commanded_ratio;
              });
}

Variable target(const scene::Scene& scene) {
  const bool of_force = scene.controller->holds_force();
  Variable variable{
      of_force ? "target_friction_force_N" : "target_friction_ratio",
      Role::input,
      of_force ? "N" : "1",
      fmt::format("Target from the next sample on, in (0, {}]; 0: the {} of the "
                  "scene, as long as no other target was given",
                  scene.highest_target(), scene.controller->texture ? "texture" : "steps"),
      0.0,
      &Inputs::target};
  variable.highest = scene.highest_target();
  return variable;
}

void add_controller_outputs(List& list, const scene::Scene& scene) {
  list.output("drive_force_amplitude_N", "N",
              "Drive amplitude in force during the carrier period that comes next", 0.0,
              [](const SteppedScene& engine) -> Value {
                return engine.controller().drive_force_amplitude_N;
              });
  if (scene.carrier_changes()) {
    list.output(
        "drive_frequency_Hz", "Hz", "Carrier frequency of the carrier period that comes next", 0.0,
        [](const SteppedScene& engine) -> Value { return engine.controller().drive_frequency_Hz; });
  }
  add_answer(list, scene.controller->arithmetic);
  list.output("state", "", "0 off, 1 calibrating, 2 running, 3 limited, 4 fault, 5 relearning",
              std::int32_t{}, [](const SteppedScene& engine) -> Value {
                return std::int32_t{engine.controller().answer.state};
              });
  list.output("limit", "", "Number of the limit that is active; 0 for none", std::int32_t{},
              [](const SteppedScene& engine) -> Value {
                return std::int32_t{engine.controller().answer.limit};
              });
  list.output("fault", "", "Number of the fault; 0 for none", std::int32_t{},
              [](const SteppedScene& engine) -> Value {
                return std::int32_t{engine.controller().answer.fault};
              });
  list.output("trace_hash", "", "FNV-1a of all answers so far, as in summary.json", std::string(),
              [](const SteppedScene& engine) -> Value {
                return fmt::format("{:016x}", engine.controller().trace_hash);
              });
}

/// As the interface writes it.
std::string unit_of(std::string_view key) {
  std::string unit = scene::unit_of(key);
  std::replace(unit.begin(), unit.end(), ' ', '.');
  return unit;
}

bool is_parameter(const std::string& table, const std::string& key, loop::Kind kind) {
  if (table == "run" || table == "tolerance" || table == "true_values" ||
      (table == "drive" && key == "frequency_Hz")) {
    return false;
  }
  const bool of_controller = table == "controller" || table == "sensor" || table == "model_error";
  if (kind == loop::Kind::plant) {
    return !of_controller && table + "." + key != "drive.force_amplitude_N";
  }
  return kind == loop::Kind::loop || table != "solver";
}

/// The numbers of the scene that can be set before a simulation begins.
void add_parameters(List& list, const scene::Scene& scene, loop::Kind kind) {
  const auto add = [&list](std::string name, const std::string& key, const Value& start) {
    std::string description = "Key " + name + " of the scene";
    list.add({std::move(name), Role::parameter, unit_of(key), std::move(description), start});
  };
  const auto echo = experiment::echo_of(scene);
  for (const auto& [table, values] : echo.items()) {
    for (const auto& [key, value] : values.items()) {
      if (!is_parameter(table, key, kind)) {
        continue;
      }
      const std::string name = fmt::format("{}.{}", table, key);
      if (value.is_number_float()) {
        add(name, key, value.template get<double>());
      } else if (value.is_number_integer() &&
                 value.template get<std::uint64_t>() <= std::numeric_limits<std::int32_t>::max()) {
        add(name, key, value.template get<std::int32_t>());
      }
    }
  }
}

}  // namespace

std::vector<Variable> variables(const configure::Experiment& experiment, loop::Kind kind) {
  const scene::Scene& scene = experiment.plant;
  List list;
  if (kind == loop::Kind::plant) {
    list.input("drive_force_amplitude_N", "N", "Amplitude of the drive during a carrier period",
               scene.drive_force_N(), &Inputs::drive_force_amplitude_N);
    if (scene.carrier_changes()) {
      list.input("drive_frequency_Hz", "Hz",
                 "Carrier frequency during a carrier period; no frequency_profile is followed",
                 scene.drive->frequency_Hz, &Inputs::drive_frequency_Hz);
    }
  }
  if (kind == loop::Kind::controller) {
    list.inputs(measured);
    if (scene.sensor.vibration) {
      list.inputs(demodulated);
    }
  }
  if (loop::has_controller(kind)) {
    list.add(target(scene));
  }
  if (loop::has_plant(kind) && scene.load) {
    list.input("load_force_N", "N",
               "Force on the load during a carrier period, beside that of the scene", 0.0,
               &Inputs::load_force_N);
  }
  if (loop::has_plant(kind)) {
    list.outputs(measured);
    if (scene.demodulates()) {
      list.outputs(demodulated);
    }
    list.outputs(series);
    if (scene.load) {
      list.outputs(of_load);
    }
  }
  if (loop::has_controller(kind)) {
    add_controller_outputs(list, scene);
  }
  add_parameters(list, experiment.nominal, kind);
  return list.take();
}

}  // namespace sonoglide::fmi
