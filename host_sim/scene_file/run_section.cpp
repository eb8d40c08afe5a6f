#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "firmware/numeric/turn.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/sections.hpp"
#include "host_sim/scene_file/table_cursor.hpp"

namespace sonoglide::scene_file {
namespace {

// Days of writing: more is a mistyped unit.
constexpr double most_fixed_steps = 1e11;
constexpr double most_recorded_rows = 1e9;

/// A time given in seconds under one key or in carrier periods under another.
double time_under(TableCursor& cursor, std::string_view key,
                  const std::optional<scene::Drive>& drive) {
  if (key.substr(key.size() - 2) == "_s") {
    return cursor.real(key);
  }
  if (!drive) {
    cursor.fail(key, "there is no period without a [drive] table; allowed: the time in s");
  }
  return cursor.real(key) / drive->frequency_Hz;
}

/// Bounds what a mistyped unit can cost.
void check_work(const TableCursor& cursor, std::string_view key, const scene::Run& run,
                const scene::Scene& so_far) {
  const double drive_Hz = so_far.drive ? so_far.drive->frequency_Hz : 0.0;
  const double natural_Hz =
      std::sqrt(so_far.plant.stiffness_N_per_m / so_far.plant.mass_kg) / numeric::two_pi;
  const double periods = run.duration_s * std::max(drive_Hz, natural_Hz);
  // The conversion of periods to seconds and back may round up.
  if (periods > most_periods * (1.0 + 1e-12)) {
    cursor.fail(key, fmt::format("{:g} s is {:g} periods of the {}; allowed: at most {:g} periods",
                                 run.duration_s, periods,
                                 drive_Hz >= natural_Hz ? "drive" : "natural mode", most_periods));
  }
  const double steps = so_far.solver.step_s > 0.0 ? run.duration_s / so_far.solver.step_s : 0.0;
  if (steps > most_fixed_steps) {
    cursor.fail(key, fmt::format("{:g} s is {:g} steps of solver.step_s; allowed: at most {:g}",
                                 run.duration_s, steps, most_fixed_steps));
  }
}

void check_whole_period(const TableCursor& cursor, std::string_view key, const scene::Run& run,
                        const scene::Drive& drive) {
  if (run.duration_s * drive.frequency_Hz < 1.0 - 1e-12) {
    cursor.fail(key, fmt::format("{:g} s is less than a carrier period, in which the controller "
                                 "acts once; allowed: at least {:g} s",
                                 run.duration_s, 1.0 / drive.frequency_Hz));
  }
}

double read_window_start(TableCursor& cursor, const std::optional<scene::Drive>& drive,
                         double duration_s) {
  const auto key = cursor.at_most_one_of("window_start_s", "window_start_periods");
  if (!key) {
    return 0.0;
  }
  const double start_s = time_under(cursor, *key, drive);
  if (!(start_s < duration_s)) {
    cursor.fail(*key, fmt::format("{:g} s is not before the end of the run; allowed: less than "
                                  "{:g} s",
                                  start_s, duration_s));
  }
  return start_s;
}

void read_record(TableCursor& cursor, scene::Run& run) {
  if (!cursor.has("record")) {
    if (cursor.has("record_interval_s")) {
      cursor.fail("record_interval_s", "not used without run.record; remove it");
    }
    return;
  }
  // An empty list switches the recording off in place: the interval may stay.
  run.record = cursor.choices("record", scene::channels);
  if (run.record.empty()) {
    cursor.optional_real("record_interval_s");
    return;
  }
  run.record_interval_s = cursor.real("record_interval_s");
  const double rows = run.duration_s / run.record_interval_s;
  if (rows > most_recorded_rows) {
    cursor.fail("record_interval_s",
                fmt::format("gives {:g} rows; allowed: at most {:g}, so at least {:g} s", rows,
                            most_recorded_rows, run.duration_s / most_recorded_rows));
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
  if (so_far.friction.has_profile()) {
    cursor.fail("start", fmt::format("nothing is steady under a {}; allowed: \"given\"",
                                     so_far.friction.profile_key()));
  }
  reject_initial_state(variant, "plant", {"initial_displacement_m", "initial_velocity_m_per_s"});
  reject_initial_state(variant, "friction", {"initial_force_N"});
}

scene::Start read_start(TableCursor& cursor, const Variant& variant, const scene::Scene& so_far) {
  const scene::Start start = cursor.choice("start", scene::starts);
  if (start == scene::Start::steady) {
    require_steady_conditions(cursor, variant, so_far);
  }
  return start;
}

}  // namespace

scene::Run read_run(const Variant& variant, const scene::Scene& so_far) {
  TableCursor cursor(variant, "run");
  if (!cursor.present()) {
    cursor.fail("missing; required: a table [run]");
  }
  const bool closed = variant.find("controller") != nullptr;
  scene::Run run;
  const std::string_view key = cursor.one_of("duration_s", "duration_periods");
  run.duration_s = time_under(cursor, key, so_far.drive);
  check_work(cursor, key, run, so_far);
  run.window_start_s = read_window_start(cursor, so_far.drive, run.duration_s);
  if (closed) {
    check_whole_period(cursor, key, run, *so_far.drive);
    run.settling_band = cursor.real("settling_band");
  } else {
    run.start = read_start(cursor, variant, so_far);
  }
  read_record(cursor, run);
  cursor.reject_unread(closed ? "in closed loop, which begins with the drive off"
                              : "in open loop, without a [controller] table");
  return run;
}

}  // namespace sonoglide::scene_file
