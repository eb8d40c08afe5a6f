#include "host_sim/scene_file/sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/solver_facts.hpp"
#include "host_sim/configure/solver_methods.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/table_cursor.hpp"

namespace sonoglide::scene_file {
namespace {

constexpr std::string_view in_open_loop = "in open loop, without a [controller] table";

bool closed_loop(const Variant& variant) {
  return variant.find("controller") != nullptr;
}

/// A cursor on a table that every scene has.
TableCursor required_table(const Variant& variant, std::string_view name) {
  TableCursor cursor(variant, name);
  if (!cursor.present()) {
    cursor.fail(fmt::format("missing; required: a table [{}]", name));
  }
  return cursor;
}

/// A cursor on a table that only closed loop uses.
TableCursor closed_loop_table(const Variant& variant, std::string_view name) {
  TableCursor cursor(variant, name);
  if (cursor.present() && !closed_loop(variant)) {
    cursor.fail(fmt::format("not used {}; remove it", in_open_loop));
  }
  return cursor;
}

/// Reads the keys that a friction law has of its own.
class KeyReader {
 public:
  explicit KeyReader(TableCursor& cursor) : cursor_(cursor) {}

  void required(std::string_view key, double& parameter, const Range& range,
                std::string_view /*meaning*/) {
    parameter = cursor_.real_in(key, range);
  }
  void optional(std::string_view key, double& parameter, const Range& range,
                std::string_view /*meaning*/) {
    parameter = cursor_.real_in(key, range, parameter);
  }
  void optional(std::string_view key, int& count, int least, int most,
                std::string_view /*meaning*/) {
    count = static_cast<int>(cursor_.integer_in(key, {least, most}, count));
  }
  void refuse(std::string_view key, double parameter, std::string_view finding, double least,
              std::string_view rest) {
    cursor_.fail(
        key, fmt::format("{} {}; allowed: at least {:.6g} {}", parameter, finding, least, rest));
  }

 private:
  TableCursor& cursor_;
};

/// A part of the friction limit: a number that holds throughout, or a profile and its value at 0 s.
/// @param absent  the default of the number
double read_part_of_limit(TableCursor& cursor, std::string_view key, std::string_view profile_key,
                          std::optional<double> absent, const scene::FrictionLaw& law,
                          scene::TimedProfile& profile) {
  if (cursor.at_most_one_of(key, profile_key) == profile_key) {
    Profile allowed = cursor.allowed<Profile>(profile_key);
    allowed.value.low_open = !scene::is_bounded(law);
    for (const auto& [time_s, value] :
         cursor.timed_values_in(profile_key, allowed, TableCursor::Times::jump)) {
      profile.push_back({time_s, value});
    }
    return scene::value_at(profile, 0.0);
  }
  return cursor.real_in(key, cursor.allowed<Number>(key).range, absent);
}

/// With the largest coefficient to come and with the smallest: a law's own keys suit both.
std::vector<scene::ContactValues> extreme_contacts(const scene::Friction& friction) {
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

bool stands(const scene::SpeedPoint& point) {
  return point.velocity_m_per_s == 0.0;
}

/// Whether the sliding stands for a while.
bool stands_still(const std::vector<scene::SpeedPoint>& profile) {
  const bool at_first = stands(profile.front()) && profile.front().time_s > 0.0;
  return at_first || stands(profile.back()) ||
         std::adjacent_find(profile.begin(), profile.end(),
                            [](const scene::SpeedPoint& one, const scene::SpeedPoint& next) {
                              return stands(one) && stands(next);
                            }) != profile.end();
}

/// Friction across the vibration needs a slip to point against.
void require_slip(TableCursor& cursor, std::string_view key, const scene::Sliding& sliding,
                  const scene::FrictionLaw& law) {
  if (scene::vibration_of(law) == friction::Vibration::across && stands_still(sliding.profile)) {
    cursor.fail(key, fmt::format("a speed that stays 0 leaves the friction law \"{}\" without a "
                                 "direction; allowed: a speed that at most passes 0",
                                 scene::name_of(law)));
  }
}

}  // namespace

scene::Plant read_plant(const Variant& variant) {
  TableCursor cursor = required_table(variant, "plant");
  scene::Plant plant;
  plant.mass_kg = cursor.real("mass_kg");
  plant.stiffness_N_per_m = cursor.real("stiffness_N_per_m");
  plant.damping_N_s_per_m = cursor.real("damping_N_s_per_m");
  plant.initial_displacement_m = cursor.real("initial_displacement_m");
  plant.initial_velocity_m_per_s = cursor.real("initial_velocity_m_per_s");
  return plant;
}

scene::Friction read_friction(const Variant& variant, const scene::Plant& plant) {
  TableCursor cursor = required_table(variant, "friction");
  scene::Friction friction;
  friction.law = cursor.choice("law", scene::friction_laws);
  if (!scene::is<scene::laws::None>(friction.law)) {
    friction.coefficient =
        read_part_of_limit(cursor, "coefficient", "coefficient_profile", std::nullopt, friction.law,
                           friction.coefficient_profile);
    friction.normal_force_N = read_part_of_limit(cursor, "normal_force_N", "normal_force_profile_N",
                                                 plant.mass_kg * standard_gravity_m_per_s2,
                                                 friction.law, friction.normal_force_profile_N);
  }
  if (!scene::is<scene::laws::None>(friction.law) && scene::vibrates_along(friction.law)) {
    friction.sign_convention = cursor.choice("sign_convention", scene::sign_conventions);
  }
  if (scene::is_elastic(friction.law)) {
    friction.contact_stiffness_N_per_m = cursor.real("contact_stiffness_N_per_m");
    const double limit_N = friction.limit_N();
    friction.initial_force_N =
        cursor.real_in("initial_force_N", {-limit_N, limit_N, "N"}, friction.initial_force_N);
  }
  KeyReader keys(cursor);
  for (const scene::ContactValues& contact : extreme_contacts(friction)) {
    std::visit([&](auto& law) { law.visit_keys(keys, contact); }, friction.law);
  }
  cursor.reject_unread_with("friction.law", scene::name_of(friction.law));
  return friction;
}

scene::Sliding read_sliding(const Variant& variant, const scene::Friction& friction) {
  TableCursor cursor = required_table(variant, "sliding");
  const std::string_view key = cursor.one_of("velocity_m_per_s", "profile");
  scene::Sliding sliding;
  if (key == "velocity_m_per_s") {
    sliding.profile.push_back({0.0, cursor.real(key)});
  } else {
    for (const auto& [time_s, velocity_m_per_s] : cursor.timed_values(key)) {
      sliding.profile.push_back({time_s, velocity_m_per_s});
    }
  }
  require_slip(cursor, key, sliding, friction.law);
  return sliding;
}

std::optional<scene::Drive> read_drive(const Variant& variant) {
  TableCursor cursor(variant, "drive");
  const bool closed = closed_loop(variant);
  if (!cursor.present()) {
    if (closed) {
      cursor.fail("missing; required: a table [drive] for the [controller] to act by");
    }
    return std::nullopt;
  }
  scene::Drive drive;
  drive.frequency_Hz = cursor.real("frequency_Hz");
  if (closed) {
    drive.max_force_amplitude_N = cursor.real("max_force_amplitude_N");
    drive.max_force_slew_N_per_s = cursor.optional_real("max_force_slew_N_per_s");
    drive.delay_periods = static_cast<int>(cursor.integer("delay_periods"));
  } else {
    drive.force_amplitude_N = cursor.real("force_amplitude_N");
  }
  drive.waveform = cursor.choice("waveform", scene::waveforms);
  cursor.reject_unread(closed ? "in closed loop: the controller sets the amplitude" : in_open_loop);
  return drive;
}

template <class Described>
std::optional<int> read_order(TableCursor& cursor) {
  const std::optional<std::int64_t> order = cursor.optional_integer("order");
  if (!order) {
    return std::nullopt;
  }
  constexpr auto& built = Described::orders;
  if (std::find(built.begin(), built.end(), *order) == built.end()) {
    cursor.fail("order",
                fmt::format("{} is not built; allowed: {}", *order, fmt::join(built, ", ")));
  }
  return static_cast<int>(*order);
}

template <class Described>
void read_keys(TableCursor& cursor, scene::Solver& solver) {
  if constexpr (Described::adaptive) {
    solver.tolerance = cursor.real("tolerance", Described::default_tolerance);
    if constexpr (Described::takes_order) {
      solver.order = read_order<Described>(cursor);
    }
    if constexpr (Described::takes_step) {
      solver.step_s = cursor.real("step_s", 0.0);
    }
  } else {
    solver.step_s = cursor.real("step_s");
  }
}

scene::Solver read_solver(const Variant& variant) {
  TableCursor cursor(variant, "solver");
  scene::Solver solver;
  solver.method = cursor.choice("method", configure::solver_methods);
  configure::for_each_solver([&](auto described, scene::SolverMethod method) {
    if (method == solver.method) {
      read_keys<decltype(described)>(cursor, solver);
    }
  });
  cursor.reject_unread_with("solver.method", configure::name_of(solver.method));
  return solver;
}

std::optional<scene::Controller> read_controller(const Variant& variant,
                                                 const scene::Scene& so_far) {
  TableCursor cursor(variant, "controller");
  if (!cursor.present()) {
    return std::nullopt;
  }
  if (!(so_far.friction.limit_N() > 0.0)) {
    cursor.fail(
        fmt::format("there is no friction to control; allowed: a friction.law other than \"none\", "
                    "with coefficient and normal_force_N above 0{}",
                    so_far.friction.has_profile() ? " at 0 s" : ""));
  }
  scene::Controller controller;
  controller.arithmetic = cursor.choice("arithmetic", scene::arithmetics);
  const auto targets = cursor.timed_values("target_friction_ratio");
  if (targets.front()[0] != 0.0) {
    cursor.fail("target_friction_ratio",
                fmt::format("begins at {} s; allowed: a first time of 0 s", targets.front()[0]));
  }
  for (const auto& [time_s, friction_ratio] : targets) {
    controller.target_friction_ratio.push_back({time_s, friction_ratio});
  }
  controller.calibration_s = cursor.real("calibration_s");
  if (!(controller.calibration_s < so_far.run.duration_s)) {
    cursor.fail("calibration_s",
                fmt::format("{} s is not before the end of the run; allowed: less than {} s",
                            controller.calibration_s, so_far.run.duration_s));
  }
  controller.shaping = cursor.choice("shaping", scene::shapings);
  controller.speed_floor_m_per_s = cursor.optional_real("speed_floor_m_per_s");
  controller.standstill_hold_s = cursor.real("standstill_hold_s");
  controller.relearn_every_s = cursor.optional_real("relearn_every_s");
  controller.mismatch_warning = cursor.real("mismatch_warning");
  return controller;
}

scene::Sensor read_sensor(const Variant& variant, const scene::Friction& friction) {
  TableCursor cursor = closed_loop_table(variant, "sensor");
  scene::Sensor sensor;
  if (const auto bits = cursor.optional_integer("adc_bits")) {
    sensor.adc_bits = static_cast<int>(*bits);
  }
  sensor.force_full_scale_N =
      cursor.real("force_full_scale_N", 2.0 * configure::largest_friction_limit_N(friction));
  sensor.force_noise_N = cursor.real("force_noise_N");
  sensor.force_bandwidth_Hz = cursor.optional_real("force_bandwidth_Hz");
  sensor.delay_periods = static_cast<int>(cursor.integer("delay_periods"));
  sensor.force_offset_N = cursor.real("force_offset_N");
  sensor.force_gain = cursor.real("force_gain");
  sensor.velocity_offset_m_per_s = cursor.real("velocity_offset_m_per_s");
  sensor.velocity_gain = cursor.real("velocity_gain");
  sensor.seed = static_cast<std::uint64_t>(cursor.integer("seed"));
  return sensor;
}

scene::ModelError read_model_error(const Variant& variant, const scene::Friction& friction) {
  TableCursor cursor = closed_loop_table(variant, "model_error");
  scene::ModelError model_error;
  model_error.mass = cursor.real("mass");
  model_error.stiffness = cursor.real("stiffness");
  model_error.coefficient = cursor.real("coefficient");
  if (scene::is_elastic(friction.law)) {
    model_error.contact_stiffness = cursor.real("contact_stiffness");
  }
  cursor.reject_unread_with("friction.law", scene::name_of(friction.law));
  return model_error;
}

}  // namespace sonoglide::scene_file
