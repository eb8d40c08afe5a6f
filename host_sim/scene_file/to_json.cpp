#include "host_sim/scene_file/to_json.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/scene_values.hpp"

namespace sonoglide::scene_file {
namespace {

using nlohmann::ordered_json;

/// The `Keys` of scene_values.hpp that write one table.
class ValueEcho {
 public:
  template <class Value>
  void value(std::string_view key, const Value& value) {
    table_[std::string(key)] = value;
  }
  template <class Value>
  void value(std::string_view key, const std::optional<Value>& value) {
    if (value) {
      this->value(key, *value);
    }
  }
  void value(std::string_view key, double number, double /*absent*/) { value(key, number); }
  void value_in(std::string_view key, double number, const Range& /*range*/) { value(key, number); }
  void value_or_0(std::string_view key, double number) {
    if (number != 0.0) {
      value(key, number);
    }
  }

  template <class Value, std::size_t Count>
  void word(std::string_view key, const Value& chosen,
            const std::array<scene::Named<Value>, Count>& names) {
    value(key, scene::name_of(names, chosen));
  }
  void word(std::string_view key, const scene::FrictionLaw& law,
            const std::array<scene::Named<scene::FrictionLaw>, scene::law_count>& /*names*/) {
    value(key, scene::name_of(law));
  }
  template <class Value, std::size_t Count>
  void words(std::string_view key, const std::vector<Value>& values,
             const std::array<scene::Named<Value>, Count>& names) {
    for (const Value each : values) {
      table_[std::string(key)].push_back(scene::name_of(names, each));
    }
  }
  template <class Value, std::size_t Count>
  void optional_word(std::string_view key, const std::optional<Value>& chosen,
                     const std::array<scene::Named<Value>, Count>& names) {
    if (chosen) {
      word(key, *chosen, names);
    }
  }
  void truth(std::string_view key, bool value) { table_[std::string(key)] = value; }
  void range(std::string_view key, const std::optional<scene::FrequencyRange>& range) {
    if (range) {
      table_[std::string(key)] = ordered_json::array({range->lowest_Hz, range->highest_Hz});
    }
  }

  template <class Integers>
  void one_of(std::string_view key, std::optional<int> chosen, const Integers& /*allowed*/) {
    value(key, chosen);
  }

  void time(std::string_view key, std::string_view /*periods_key*/, double time_s,
            const std::optional<scene::Drive>& /*drive*/) {
    value(key, time_s);
  }
  void level(const Level& level, ZeroIn /*zero*/, std::optional<double> /*absent*/) {
    if (level.profile.empty()) {
      value(level.key, level.value);
    }
    profile(level.profile_key, level.profile);
  }
  void profile(std::string_view key, const scene::TimedProfile& profile) {
    for (const scene::TimedValue& row : profile) {
      add_pair(key, row.time_s, row.value);
    }
  }
  void speed(std::string_view key, std::string_view profile_key,
             const std::vector<scene::SpeedPoint>& points) {
    if (points.size() == 1 && points.front().time_s == 0.0) {
      value(key, points.front().velocity_m_per_s);
      return;
    }
    for (const scene::SpeedPoint& point : points) {
      add_pair(profile_key, point.time_s, point.velocity_m_per_s);
    }
  }
  void targets(std::string_view key, const std::vector<scene::TargetStep>& steps) {
    for (const scene::TargetStep& step : steps) {
      add_pair(key, step.time_s, step.friction_ratio);
    }
  }

  void required(std::string_view key, double parameter, const Range& /*range*/,
                std::string_view /*meaning*/) {
    value(key, parameter);
  }
  void optional(std::string_view key, double parameter, const Range& /*range*/,
                std::string_view /*meaning*/) {
    value(key, parameter);
  }
  void optional(std::string_view key, int count, int /*least*/, int /*most*/,
                std::string_view /*meaning*/) {
    value(key, count);
  }
  void refuse(std::string_view /*key*/, double /*parameter*/, std::string_view /*finding*/,
              double /*least*/, std::string_view /*rest*/) {}

  ordered_json take() { return std::move(table_); }

 private:
  void add_pair(std::string_view key, double time_s, double value) {
    table_[std::string(key)].push_back(ordered_json::array({time_s, value}));
  }

  ordered_json table_ = ordered_json::object();
};

template <class Visit>
ordered_json echo(const Visit& visit) {
  ValueEcho keys;
  visit(keys);
  return keys.take();
}

ordered_json number(double value, bool whole) {
  return whole ? ordered_json(static_cast<std::int64_t>(value)) : ordered_json(value);
}

ordered_json spread(const scene::Tolerance& tolerance) {
  switch (tolerance.spread) {
    case scene::Spread::half_width:
      return tolerance.amount;
    case scene::Spread::normal:
      return {{"normal", tolerance.amount}};
    case scene::Spread::range:
      break;
  }
  return {{"range", ordered_json::array({number(tolerance.lowest, tolerance.whole),
                                         number(tolerance.highest, tolerance.whole)})}};
}

void add_truth(ordered_json& root, const scene::Scene& scene) {
  for (const scene::Tolerance& each : scene.tolerances) {
    root["tolerance"][each.key] = spread(each);
  }
  for (const scene::TrueValue& each : scene.true_values) {
    root["true_values"][each.key] = number(each.value, each.whole);
  }
}

/// @param scene  a copy, for the visitors of scene_values.hpp may write too
ordered_json stated(scene::Scene scene) {
  const bool closed_loop = scene.controller.has_value();
  const scene::Start start = scene.run.start;
  ordered_json root;
  root["plant"] = echo([&](auto& keys) { visit_plant(keys, scene.plant, start); });
  root["friction"] =
      echo([&](auto& keys) { visit_friction(keys, scene.friction, scene.plant, start); });
  root["sliding"] = echo([&](auto& keys) { visit_sliding(keys, scene.sliding); });
  if (scene.transducer) {
    root["transducer"] = echo([&](auto& keys) { visit_transducer(keys, *scene.transducer); });
  }
  if (scene.drive) {
    root["drive"] = echo([&](auto& keys) {
      visit_drive(keys, *scene.drive, closed_loop, scene.transducer.has_value());
    });
  }
  root["solver"] = echo([&](auto& keys) { visit_solver(keys, scene.solver); });
  root["run"] = echo([&](auto& keys) { visit_run(keys, scene.run, scene.drive, closed_loop); });
  if (closed_loop) {
    const bool holds = scene.vibration_mode() != scene::VibrationMode::feedforward;
    root["controller"] =
        echo([&](auto& keys) { visit_controller(keys, *scene.controller, scene.sensor.force); });
    root["sensor"] = echo([&](auto& keys) {
      visit_sensor(keys, scene.sensor, scene.sensor.force_full_scale_N, holds);
    });
    root["model_error"] = echo([&](auto& keys) {
      visit_model_error(keys, scene.model_error, scene.friction.law, holds,
                        scene.transducer.has_value());
    });
  }
  return root;
}

}  // namespace

ordered_json to_json(const scene::Scene& scene) {
  ordered_json root = stated(scene.nominal());
  add_truth(root, scene);
  return root;
}

}  // namespace sonoglide::scene_file
