#include "host_sim/scene_file/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/bound.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/solver_facts.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/scene_values.hpp"
#include "host_sim/scene_file/table_cursor.hpp"
#include "host_sim/scene_file/value_reader.hpp"

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

/// Amplitudes are voltages with a transducer, and forces without.
void reject_other_amplitudes(const TableCursor& cursor, bool closed, bool in_volts) {
  const auto refuse = [&](std::initializer_list<std::string_view> keys, std::string_view finding,
                          std::string_view open_key, std::string_view closed_key) {
    for (const std::string_view key : keys) {
      if (cursor.has(key)) {
        cursor.fail(key, fmt::format("{}; allowed: {}", finding, closed ? closed_key : open_key));
      }
    }
  };
  if (in_volts) {
    refuse({"force_amplitude_N", "max_force_amplitude_N", "max_force_slew_N_per_s"},
           "is a force, but with a [transducer] the drive is a voltage", "voltage_amplitude_V",
           "max_voltage_amplitude_V");
  } else {
    refuse({"voltage_amplitude_V", "max_voltage_amplitude_V"},
           "is a voltage, but without a [transducer] the drive is a force", "force_amplitude_N",
           "max_force_amplitude_N");
  }
}

/// The current into a capacitance has no bound where the voltage jumps.
void require_cosine(const TableCursor& cursor, scene::Waveform waveform) {
  if (waveform != scene::Waveform::cosine) {
    cursor.fail("waveform", fmt::format("\"{}\" is not for a [transducer]; allowed: \"cosine\"",
                                        scene::name_of(scene::waveforms, waveform)));
  }
}

/// A coarser word would have no frequency near the one that is asked for.
void settle_frequency(const TableCursor& cursor, scene::Drive& drive) {
  const double lowest_Hz = drive.frequency_profile.empty()
                               ? drive.frequency_Hz
                               : scene::smallest_value(drive.frequency_profile);
  if (drive.frequency_resolution_Hz > lowest_Hz) {
    cursor.fail("frequency_resolution_Hz",
                fmt::format("{:g} Hz is above the carrier frequency; allowed: at most {} Hz",
                            drive.frequency_resolution_Hz, configure::at_most(lowest_Hz)));
  }
  drive.frequency_Hz = configure::nearest_frequency_Hz(drive, drive.frequency_Hz);
}

constexpr std::string_view without_resonance = "without controller.vibration = \"resonant\"";
constexpr std::string_view unobserved = "without controller.vibration";

/// The frequency of a resonant drive is told by its deviation from the start.
constexpr double largest_deviation = 0.06;

void check_frequency_range(const TableCursor& cursor, const scene::FrequencyRange& range,
                           double start_Hz) {
  if (!(range.lowest_Hz < start_Hz && start_Hz < range.highest_Hz)) {
    cursor.fail("frequency_range_Hz",
                fmt::format("drive.frequency_Hz, where the drive starts, is {:g} Hz; allowed: a "
                            "range that begins below and ends above it",
                            start_Hz));
  }
  const double lowest_Hz = (1.0 - largest_deviation) * start_Hz;
  const double highest_Hz = (1.0 + largest_deviation) * start_Hz;
  if (range.lowest_Hz < lowest_Hz || range.highest_Hz > highest_Hz) {
    cursor.fail("frequency_range_Hz",
                fmt::format("[{:g}, {:g}] leaves the range that the controller can follow; "
                            "allowed: {} to {} Hz, 6 % about drive.frequency_Hz",
                            range.lowest_Hz, range.highest_Hz, configure::at_least(lowest_Hz),
                            configure::at_most(highest_Hz)));
  }
}

void check_resonance(const TableCursor& cursor, const TableCursor& drive,
                     const scene::Controller& controller, const scene::Scene& so_far) {
  if (!so_far.transducer) {
    cursor.fail("vibration",
                "\"resonant\" needs a table [transducer], whose voltage drives the resonance");
  }
  // A word has 28 bits at the most.
  constexpr double finest = 0x1p-28;
  const double start_Hz = so_far.drive->frequency_Hz;
  const double finest_Hz = start_Hz * finest;
  const double coarsest_Hz = start_Hz / 64.0;
  const double resolution_Hz = so_far.drive->frequency_resolution_Hz;
  if (resolution_Hz > coarsest_Hz || (resolution_Hz > 0.0 && resolution_Hz < finest_Hz)) {
    // The start is a multiple of it, and another one of another resolution.
    drive.fail("frequency_resolution_Hz",
               fmt::format("{:g} Hz is too {} to follow a resonance; allowed: 0, or {} to {} Hz",
                           resolution_Hz, resolution_Hz < finest_Hz ? "fine" : "coarse",
                           configure::at_least((start_Hz + 0.5 * resolution_Hz) * finest, 3),
                           configure::at_most((start_Hz - 0.5 * resolution_Hz) / 64.5)));
  }
  if (controller.frequency_range_Hz) {
    check_frequency_range(cursor, *controller.frequency_range_Hz, so_far.drive->frequency_Hz);
  }
}

/// The observer foresees the vibration of a cosine whose amplitude changes at once.
void check_damping(const TableCursor& drive, const scene::Drive& values) {
  if (drive.has("max_force_slew_N_per_s")) {
    drive.reject("max_force_slew_N_per_s", "with controller.vibration = \"damped\"");
  }
  if (values.waveform != scene::Waveform::cosine) {
    drive.fail("waveform", fmt::format("\"{}\" is not for controller.vibration = \"damped\"; "
                                       "allowed: \"cosine\"",
                                       scene::name_of(scene::waveforms, values.waveform)));
  }
}

/// What only a loop that observes the vibration has, and what it does not have.
void check_vibration_control(const TableCursor& cursor, const Variant& variant,
                             const scene::Controller& controller, const scene::Scene& so_far) {
  const TableCursor drive(variant, "drive");
  const bool resonant = controller.vibration == scene::VibrationControl::resonant;
  if (!resonant && drive.has("max_current_amplitude_A")) {
    drive.reject("max_current_amplitude_A", without_resonance);
  }
  if (!controller.vibration) {
    if (controller.shaping != scene::Shaping::robust && cursor.has("shaping_range")) {
      cursor.reject("shaping_range", "without controller.shaping = \"robust\"");
    }
    cursor.reject_unread(without_resonance);
    return;
  }
  const std::string name(scene::name_of(scene::vibration_controls, *controller.vibration));
  if (controller.arithmetic == scene::Arithmetic::q15) {
    cursor.fail("arithmetic",
                fmt::format("\"q15\" is too coarse for controller.vibration = \"{}\"; allowed: "
                            "\"float32\", \"q31\", \"float64\"",
                            name));
  }
  if (resonant) {
    check_resonance(cursor, drive, controller, so_far);
  } else {
    check_damping(drive, *so_far.drive);
  }
  cursor.reject_unread(fmt::format("with controller.vibration = \"{}\"", name));
}

/// The vibration must be seen or felt, and without a force sensor nothing tells of the friction.
void check_sensing(const TableCursor& cursor, const Variant& variant, const scene::Sensor& sensor,
                   const scene::Scene& so_far) {
  if (!sensor.vibration && so_far.resonant()) {
    cursor.fail(
        "vibration",
        fmt::format("missing: controller.vibration = \"{}\" observes the vibration; "
                    "required: \"velocity\" or \"motional_current\"",
                    scene::name_of(scene::vibration_controls, *so_far.controller->vibration)));
  }
  if (sensor.vibration == scene::VibrationSensor::motional_current && !so_far.transducer) {
    cursor.fail("vibration",
                "\"motional_current\" needs a table [transducer], whose current it "
                "is; allowed: \"velocity\"");
  }
  if (sensor.force) {
    return;
  }
  if (!sensor.vibration) {
    cursor.fail("force",
                "false, and without sensor.vibration nothing tells of the vibration; required: one "
                "of the two");
  }
  const TableCursor controller(variant, "controller");
  for (const std::string_view key : {"calibration_s", "relearn_every_s", "mismatch_warning"}) {
    if (controller.has(key)) {
      controller.reject(key, "with sensor.force = false");
    }
  }
}

// Days of writing: more is a mistyped unit.
constexpr double most_fixed_steps = 1e11;
constexpr double most_recorded_rows = 1e9;

double largest(double value, const scene::TimedProfile& in_its_place) {
  return in_its_place.empty() ? value : scene::largest_value(in_its_place);
}

/// Bounds what a mistyped unit can cost.
void check_work(const TableCursor& cursor, std::string_view key, const scene::Run& run,
                const scene::Scene& so_far) {
  const scene::Plant& plant = so_far.plant;
  const double drive_Hz =
      so_far.drive ? largest(so_far.drive->frequency_Hz, so_far.drive->frequency_profile) : 0.0;
  const double natural_Hz =
      std::sqrt(largest(plant.stiffness_N_per_m, plant.stiffness_profile) / plant.mass_kg) /
      numeric::two_pi;
  // The conversion of periods to seconds and back may round up.
  constexpr double rounding = 1e-12;
  const auto most = [&](double most_s) {
    return key == "duration_periods"
               ? configure::at_most(most_s * so_far.drive->frequency_Hz) + " periods"
               : configure::at_most(most_s) + " s";
  };
  const double quickest_Hz = std::max(drive_Hz, natural_Hz);
  if (run.duration_s * quickest_Hz > most_periods * (1.0 + rounding)) {
    cursor.fail(key, fmt::format("{:g} s is {:g} periods of the {}; allowed: at most {}",
                                 run.duration_s, run.duration_s * quickest_Hz,
                                 drive_Hz >= natural_Hz ? "drive" : "natural mode",
                                 most(most_periods / quickest_Hz)));
  }
  const double longest_s = most_fixed_steps * so_far.solver.step_s;
  if (longest_s > 0.0 && run.duration_s > longest_s * (1.0 + rounding)) {
    cursor.fail(
        key, fmt::format("{:g} s is {:g} steps of solver.step_s; allowed: at most {}",
                         run.duration_s, run.duration_s / so_far.solver.step_s, most(longest_s)));
  }
}

void check_whole_period(const TableCursor& cursor, std::string_view key, const scene::Run& run,
                        const scene::Drive& drive) {
  if (run.duration_s * drive.frequency_Hz < 1.0 - 1e-12) {
    cursor.fail(key, fmt::format("{:g} s is less than a carrier period, in which the controller "
                                 "acts once; allowed: at least {}",
                                 run.duration_s,
                                 key == "duration_periods"
                                     ? "1 period"
                                     : configure::at_least(1.0 / drive.frequency_Hz) + " s"));
  }
}

void reject_initial_state(const Variant& variant, std::string_view table,
                          std::initializer_list<std::string_view> keys) {
  const TableCursor cursor(variant, table);
  for (const std::string_view key : keys) {
    if (cursor.has(key)) {
      cursor.reject(key, "with run.start = \"steady\"");
    }
  }
}

/// A steady orbit has the period of the drive, and nothing that changes from one to the next.
void require_steady_conditions(const TableCursor& cursor, const Variant& variant,
                               const scene::Scene& so_far) {
  if (!so_far.drive) {
    cursor.fail("start", "there is no period without a [drive] table; allowed: \"given\"");
  }
  if (so_far.sliding.profile.size() != 1) {
    cursor.fail("start", "nothing is steady under a sliding.profile; allowed: \"given\"");
  }
  if (const char* key = so_far.profile_key()) {
    cursor.fail("start", fmt::format("nothing is steady under a {}; allowed: \"given\"", key));
  }
  reject_initial_state(variant, "plant", {"initial_displacement_m", "initial_velocity_m_per_s"});
  reject_initial_state(variant, "friction", {"initial_force_N"});
}

/// A shorter window than the rounding of its times holds nothing.
void check_window(const TableCursor& cursor, std::string_view key, const scene::Run& run,
                  const std::optional<scene::Drive>& drive) {
  const double period_s = drive ? 1.0 / drive->frequency_Hz : 1e-3 * run.duration_s;
  const double rounding_s =
      2e-9 * period_s + 8.0 * std::numeric_limits<double>::epsilon() * run.duration_s;
  if (!(run.window_start_s < run.duration_s - rounding_s)) {
    const bool in_periods = key == "window_start_periods";
    cursor.fail(key, fmt::format("{:g} s is not before the end of the run; allowed: at most {} {}",
                                 run.window_start_s,
                                 configure::at_most((run.duration_s - rounding_s) /
                                                    (in_periods ? period_s : 1.0)),
                                 in_periods ? "periods" : "s"));
  }
}

void check_record(TableCursor& cursor, const scene::Run& run) {
  if (run.record.empty()) {
    if (!cursor.has("record") && cursor.has("record_interval_s")) {
      cursor.fail("record_interval_s", "not used without run.record; remove it");
    }
    // An empty list switches the recording off in place: the interval may stay.
    cursor.optional_real("record_interval_s");
    return;
  }
  const double shortest_s = run.duration_s / most_recorded_rows;
  if (run.record_interval_s < shortest_s) {
    cursor.fail("record_interval_s",
                fmt::format("gives {:g} rows; allowed: at most {:g}, so at least {} s",
                            run.duration_s / run.record_interval_s, most_recorded_rows,
                            configure::at_least(shortest_s)));
  }
}

}  // namespace

scene::Plant read_plant(const Variant& variant) {
  TableCursor cursor = required_table(variant, "plant");
  ValueReader reader(cursor);
  scene::Plant plant;
  visit_plant(reader, plant, scene::Start::given);
  return plant;
}

scene::Friction read_friction(const Variant& variant, const scene::Plant& plant) {
  TableCursor cursor = required_table(variant, "friction");
  ValueReader reader(cursor);
  scene::Friction friction;
  visit_friction(reader, friction, plant, scene::Start::given);
  cursor.reject_unread_with("friction.law", scene::name_of(friction.law));
  return friction;
}

scene::Sliding read_sliding(const Variant& variant, const scene::Friction& friction) {
  TableCursor cursor = required_table(variant, "sliding");
  ValueReader reader(cursor);
  scene::Sliding sliding;
  visit_sliding(reader, sliding);
  require_slip(cursor, cursor.one_of("velocity_m_per_s", "profile"), sliding, friction.law);
  return sliding;
}

std::optional<scene::Transducer> read_transducer(const Variant& variant) {
  TableCursor cursor(variant, "transducer");
  if (!cursor.present()) {
    return std::nullopt;
  }
  if (variant.find("drive") == nullptr) {
    cursor.fail("not used without a table [drive]; remove it");
  }
  ValueReader reader(cursor);
  scene::Transducer transducer;
  visit_transducer(reader, transducer);
  return transducer;
}

std::optional<scene::Drive> read_drive(const Variant& variant,
                                       const std::optional<scene::Transducer>& transducer) {
  TableCursor cursor(variant, "drive");
  const bool closed = closed_loop(variant);
  if (!cursor.present()) {
    if (closed) {
      cursor.fail("missing; required: a table [drive] for the [controller] to act by");
    }
    return std::nullopt;
  }
  reject_other_amplitudes(cursor, closed, transducer.has_value());
  ValueReader reader(cursor);
  scene::Drive drive;
  visit_drive(reader, drive, closed, transducer.has_value());
  settle_frequency(cursor, drive);
  if (transducer) {
    require_cosine(cursor, drive.waveform);
    drive.force_amplitude_N = transducer->force_factor_N_per_V * drive.voltage_amplitude_V;
    drive.max_force_amplitude_N = transducer->force_factor_N_per_V * drive.max_voltage_amplitude_V;
  }
  if (!transducer && cursor.has("max_current_amplitude_A")) {
    cursor.reject("max_current_amplitude_A", "without a [transducer]");
  }
  cursor.reject_unread(closed ? "in closed loop: the controller sets the amplitude" : in_open_loop);
  return drive;
}

scene::Solver read_solver(const Variant& variant) {
  TableCursor cursor(variant, "solver");
  ValueReader reader(cursor);
  scene::Solver solver;
  visit_solver(reader, solver);
  cursor.reject_unread_with("solver.method", configure::name_of(solver.method));
  return solver;
}

scene::Run read_run(const Variant& variant, const scene::Scene& so_far) {
  TableCursor cursor = required_table(variant, "run");
  const bool closed = closed_loop(variant);
  ValueReader reader(cursor);
  scene::Run run;
  visit_run(reader, run, so_far.drive, closed);
  const std::string_view duration = cursor.one_of("duration_s", "duration_periods");
  check_work(cursor, duration, run, so_far);
  check_window(cursor, cursor.one_of("window_start_s", "window_start_periods"), run, so_far.drive);
  if (closed) {
    check_whole_period(cursor, duration, run, *so_far.drive);
  } else if (run.start == scene::Start::steady) {
    require_steady_conditions(cursor, variant, so_far);
  }
  check_record(cursor, run);
  cursor.reject_unread(closed ? "in closed loop, which begins with the drive off" : in_open_loop);
  return run;
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
  ValueReader reader(cursor);
  scene::Controller controller;
  visit_controller(reader, controller, true);
  check_vibration_control(cursor, variant, controller, so_far);
  if (!(controller.calibration_s < so_far.run.duration_s)) {
    cursor.fail("calibration_s",
                fmt::format("{} s is not before the end of the run; allowed: less than {} s",
                            controller.calibration_s, so_far.run.duration_s));
  }
  return controller;
}

scene::Sensor read_sensor(const Variant& variant, const scene::Scene& so_far) {
  TableCursor cursor = closed_loop_table(variant, "sensor");
  ValueReader reader(cursor);
  scene::Sensor sensor;
  const bool holds = so_far.vibration_mode() != scene::VibrationMode::feedforward;
  visit_sensor(reader, sensor, 2.0 * configure::largest_friction_limit_N(so_far.friction), holds);
  if (holds) {
    check_sensing(cursor, variant, sensor, so_far);
  }
  cursor.reject_unread(!sensor.force ? "with sensor.force = false"
                       : holds       ? "without sensor.vibration"
                                     : unobserved);
  return sensor;
}

scene::ModelError read_model_error(const Variant& variant, const scene::Scene& so_far) {
  TableCursor cursor = closed_loop_table(variant, "model_error");
  ValueReader reader(cursor);
  scene::ModelError model_error;
  const bool holds = so_far.vibration_mode() != scene::VibrationMode::feedforward;
  visit_model_error(reader, model_error, so_far.friction.law, holds, so_far.transducer.has_value());
  for (const std::string_view key : {"force_factor", "damping"}) {
    if (cursor.has(key) && !holds) {
      cursor.reject(key, unobserved);
    }
  }
  if (cursor.has("force_factor") && !so_far.transducer) {
    cursor.reject("force_factor", "without a [transducer]");
  }
  cursor.reject_unread_with("friction.law", scene::name_of(so_far.friction.law));
  return model_error;
}

}  // namespace sonoglide::scene_file
