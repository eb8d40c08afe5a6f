#include "host_sim/scene_file/to_json.hpp"

#include "host_sim/configure/solver_facts.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/keys.hpp"

namespace sonoglide::scene_file {
namespace {

using nlohmann::ordered_json;

template <class Value>
void add_if_set(ordered_json& table, const char* key, const std::optional<Value>& value) {
  if (value) {
    table[key] = *value;
  }
}

ordered_json echo(const scene::Plant& plant, scene::Start start) {
  ordered_json table{{"mass_kg", plant.mass_kg},
                     {"stiffness_N_per_m", plant.stiffness_N_per_m},
                     {"damping_N_s_per_m", plant.damping_N_s_per_m}};
  if (start == scene::Start::given) {
    table["initial_displacement_m"] = plant.initial_displacement_m;
    table["initial_velocity_m_per_s"] = plant.initial_velocity_m_per_s;
  }
  return table;
}

/// Echoes the keys that a friction law has of its own.
class KeyEcho {
 public:
  explicit KeyEcho(ordered_json& table) : table_(table) {}

  void required(std::string_view key, double parameter, const Range& /*range*/,
                std::string_view /*meaning*/) {
    table_[std::string(key)] = parameter;
  }
  void optional(std::string_view key, double parameter, const Range& range,
                std::string_view meaning) {
    required(key, parameter, range, meaning);
  }
  void optional(std::string_view key, int count, int /*least*/, int /*most*/,
                std::string_view /*meaning*/) {
    table_[std::string(key)] = count;
  }
  void refuse(std::string_view /*key*/, double /*parameter*/, std::string_view /*finding*/,
              double /*least*/, std::string_view /*rest*/) {}

 private:
  ordered_json& table_;
};

/// A number that holds throughout, or its profile.
void add_level(ordered_json& table, const char* key, double value, const char* profile_key,
               const scene::TimedProfile& profile) {
  if (profile.empty()) {
    table[key] = value;
    return;
  }
  ordered_json rows = ordered_json::array();
  for (const scene::TimedValue& row : profile) {
    rows.push_back(ordered_json::array({row.time_s, row.value}));
  }
  table[profile_key] = rows;
}

ordered_json echo(const scene::Friction& friction, scene::Start start) {
  ordered_json table{{"law", scene::name_of(friction.law)}};
  if (scene::is<scene::laws::None>(friction.law)) {
    return table;
  }
  add_level(table, "coefficient", friction.coefficient, "coefficient_profile",
            friction.coefficient_profile);
  add_level(table, "normal_force_N", friction.normal_force_N, "normal_force_profile_N",
            friction.normal_force_profile_N);
  if (scene::is_elastic(friction.law)) {
    table["contact_stiffness_N_per_m"] = friction.contact_stiffness_N_per_m;
    if (start == scene::Start::given) {
      table["initial_force_N"] = friction.initial_force_N;
    }
  }
  KeyEcho keys(table);
  scene::FrictionLaw law = friction.law;
  std::visit([&](auto& any) { any.visit_keys(keys, friction); }, law);
  if (scene::vibrates_along(friction.law)) {
    table["sign_convention"] = scene::name_of(scene::sign_conventions, friction.sign_convention);
  }
  return table;
}

ordered_json echo(const scene::Sliding& sliding) {
  if (sliding.profile.size() == 1 && sliding.profile.front().time_s == 0.0) {
    return {{"velocity_m_per_s", sliding.profile.front().velocity_m_per_s}};
  }
  ordered_json profile = ordered_json::array();
  for (const scene::SpeedPoint& point : sliding.profile) {
    profile.push_back(ordered_json::array({point.time_s, point.velocity_m_per_s}));
  }
  ordered_json table;
  table["profile"] = profile;
  return table;
}

ordered_json echo(const scene::Drive& drive, bool closed_loop) {
  ordered_json table{{"frequency_Hz", drive.frequency_Hz}};
  if (!closed_loop) {
    table["force_amplitude_N"] = drive.force_amplitude_N;
  }
  table["waveform"] = scene::name_of(scene::waveforms, drive.waveform);
  if (closed_loop) {
    table["max_force_amplitude_N"] = drive.max_force_amplitude_N;
    add_if_set(table, "max_force_slew_N_per_s", drive.max_force_slew_N_per_s);
    table["delay_periods"] = drive.delay_periods;
  }
  return table;
}

ordered_json echo(const scene::Solver& solver) {
  ordered_json table{{"method", configure::name_of(solver.method)}};
  if (configure::is_adaptive(solver.method)) {
    table["tolerance"] = solver.tolerance;
    if (solver.order) {
      table["order"] = *solver.order;
    }
  }
  if (solver.step_s > 0.0) {
    table["step_s"] = solver.step_s;
  }
  return table;
}

ordered_json echo(const scene::Run& run, bool closed_loop) {
  ordered_json table{{"duration_s", run.duration_s}, {"window_start_s", run.window_start_s}};
  if (closed_loop) {
    table["settling_band"] = run.settling_band;
  } else {
    table["start"] = scene::name_of(scene::starts, run.start);
  }
  if (!run.record.empty()) {
    ordered_json record = ordered_json::array();
    for (const scene::Channel channel : run.record) {
      record.push_back(scene::name_of(scene::channels, channel));
    }
    table["record"] = record;
    table["record_interval_s"] = run.record_interval_s;
  }
  return table;
}

ordered_json echo(const scene::Controller& controller) {
  ordered_json targets = ordered_json::array();
  for (const scene::TargetStep& step : controller.target_friction_ratio) {
    targets.push_back(ordered_json::array({step.time_s, step.friction_ratio}));
  }
  ordered_json table{{"arithmetic", scene::name_of(scene::arithmetics, controller.arithmetic)}};
  table["target_friction_ratio"] = targets;
  table["calibration_s"] = controller.calibration_s;
  table["shaping"] = scene::name_of(scene::shapings, controller.shaping);
  add_if_set(table, "speed_floor_m_per_s", controller.speed_floor_m_per_s);
  table["standstill_hold_s"] = controller.standstill_hold_s;
  add_if_set(table, "relearn_every_s", controller.relearn_every_s);
  table["mismatch_warning"] = controller.mismatch_warning;
  return table;
}

ordered_json echo(const scene::Sensor& sensor) {
  ordered_json table = ordered_json::object();
  add_if_set(table, "adc_bits", sensor.adc_bits);
  table["force_full_scale_N"] = sensor.force_full_scale_N;
  table["force_noise_N"] = sensor.force_noise_N;
  add_if_set(table, "force_bandwidth_Hz", sensor.force_bandwidth_Hz);
  table["delay_periods"] = sensor.delay_periods;
  table["force_offset_N"] = sensor.force_offset_N;
  table["force_gain"] = sensor.force_gain;
  table["velocity_offset_m_per_s"] = sensor.velocity_offset_m_per_s;
  table["velocity_gain"] = sensor.velocity_gain;
  table["seed"] = sensor.seed;
  return table;
}

ordered_json echo(const scene::ModelError& model_error, const scene::FrictionLaw& law) {
  ordered_json table{{"mass", model_error.mass},
                     {"stiffness", model_error.stiffness},
                     {"coefficient", model_error.coefficient}};
  if (scene::is_elastic(law)) {
    table["contact_stiffness"] = model_error.contact_stiffness;
  }
  return table;
}

}  // namespace

ordered_json to_json(const scene::Scene& scene) {
  const bool closed_loop = scene.controller.has_value();
  ordered_json root;
  root["plant"] = echo(scene.plant, scene.run.start);
  root["friction"] = echo(scene.friction, scene.run.start);
  root["sliding"] = echo(scene.sliding);
  if (scene.drive) {
    root["drive"] = echo(*scene.drive, closed_loop);
  }
  root["solver"] = echo(scene.solver);
  root["run"] = echo(scene.run, closed_loop);
  if (closed_loop) {
    root["controller"] = echo(*scene.controller);
    root["sensor"] = echo(scene.sensor);
    root["model_error"] = echo(scene.model_error, scene.friction.law);
  }
  return root;
}

}  // namespace sonoglide::scene_file
