#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host_sim/scene/bound.hpp"
#include "host_sim/scene/cores/solver_choice.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/scene_file/checks.hpp"

// What solver and run owe to the tables before them.

namespace sonoglide::scene_file {
namespace {

/// The words of those for which `holds(method)`.
template <class Condition>
std::string methods_that(const Condition& holds) {
  std::string words;
  for (const scene::Named<scene::SolverMethod>& each : scene::solver_methods) {
    if (holds(each.value)) {
      words += fmt::format("{}\"{}\"", words.empty() ? "" : ", ", each.name);
    }
  }
  return words;
}

void require_solvable(const TableCursor& cursor, const scene::Scene& scene) {
  const scene::SolverMethod method = scene.solver.method;
  if (scene::solves(method, scene.friction.law)) {
    return;
  }
  const std::string allowed = methods_that(
      [&](scene::SolverMethod each) { return scene::solves(each, scene.friction.law); });
  cursor.fail("method",
              fmt::format("\"{}\" does not solve the friction law \"{}\"; allowed: {}",
                          scene::name_of(method), scene::name_of(scene.friction.law), allowed));
}

void require_load_solved(const TableCursor& cursor, const scene::Scene& scene) {
  const scene::SolverMethod method = scene.solver.method;
  if (scene.load && !scene::moves_load(method)) {
    cursor.fail("method", fmt::format("\"{}\" does not solve a [load]; allowed: {}",
                                      scene::name_of(method), methods_that(scene::moves_load)));
  }
}

void require_built(const TableCursor& cursor, const scene::Solver& solver) {
  const std::vector<int> orders = scene::built_orders(solver.method);
  if (solver.order && std::find(orders.begin(), orders.end(), *solver.order) == orders.end()) {
    cursor.fail("order", fmt::format("{} is not built; allowed: {}", *solver.order,
                                     fmt::join(orders, ", ")));
  }
}

/// A drive of straight pieces is solved by fewer methods, and in one order.
void settle_waveform(const TableCursor& cursor, scene::Scene& scene) {
  if (!scene.drive || scene.drive->waveform == scene::Waveform::cosine) {
    return;
  }
  const auto fail = [&](const char* key, std::string_view value, std::string_view allowed) {
    cursor.fail(key, fmt::format("{} does not follow the waveform \"{}\"; allowed: {}", value,
                                 scene::name_of(scene::waveforms, scene.drive->waveform), allowed));
  };
  scene::Solver& solver = scene.solver;
  if (!scene::follows_straight_drives(solver.method)) {
    fail("method", scene::name_of(solver.method), methods_that(scene::follows_straight_drives));
  }
  const std::optional<int> only = scene::straight_order(solver.method);
  if (only && solver.order.value_or(*only) != *only) {
    fail("order", std::to_string(*solver.order), std::to_string(*only));
  }
  solver.order = only;
}

// Days of writing: more is a mistyped unit.
constexpr double most_fixed_steps = 1e11;
constexpr double most_recorded_rows = 1e9;

/// Bounds what a mistyped unit can cost.
void check_work(const TableCursor& cursor, std::string_view key, const scene::Scene& so_far) {
  const scene::Run& run = so_far.run;
  const double drive_Hz = so_far.drive ? so_far.drive->highest_frequency_Hz() : 0.0;
  const double natural_Hz =
      scene::natural_Hz(so_far.plant.stiffest_N_per_m(), so_far.plant.mass_kg);
  // The conversion of periods to seconds and back may round up.
  constexpr double rounding = 1e-12;
  const auto most = [&](double most_s) {
    return key == "duration_periods"
               ? scene::at_most(most_s * so_far.drive->frequency_Hz) + " periods"
               : scene::at_most(most_s) + " s";
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
                                     : scene::at_least(1.0 / drive.frequency_Hz) + " s"));
  }
}

/// A steady orbit has the period of the drive, and nothing that changes from one to the next.
void require_steady_conditions(const TableCursor& cursor, const scene::Scene& so_far) {
  if (!so_far.drive) {
    cursor.fail("start", "there is no period without a [drive] table; allowed: \"given\"");
  }
  if (so_far.load) {
    cursor.fail("start", "nothing is steady under a [load]; allowed: \"given\"");
  }
  if (so_far.sliding.profile.size() != 1) {
    cursor.fail("start", "nothing is steady under a sliding.profile; allowed: \"given\"");
  }
  if (const char* key = so_far.profile_key()) {
    cursor.fail("start", fmt::format("nothing is steady under a {}; allowed: \"given\"", key));
  }
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
                                 scene::at_most((run.duration_s - rounding_s) /
                                                (in_periods ? period_s : 1.0)),
                                 in_periods ? "periods" : "s"));
  }
}

void check_record(const TableCursor& cursor, const scene::Scene& so_far) {
  const scene::Run& run = so_far.run;
  if (!so_far.load && std::find(run.record.begin(), run.record.end(),
                                scene::Channel::load_displacement) != run.record.end()) {
    cursor.fail("record", "\"load_displacement_m\" is not there without a [load]; remove it");
  }
  if (run.record.empty()) {
    if (!cursor.has("record") && cursor.has("record_interval_s")) {
      cursor.fail("record_interval_s", "not used without run.record; remove it");
    }
    if (cursor.has("record_interval_s")) {
      const Key& interval = key_of(cursor.keys(), "record_interval_s");
      cursor.real(interval.name, std::get<Number>(interval.allowed).range);
    }
    return;
  }
  const double shortest_s = run.duration_s / most_recorded_rows;
  if (run.record_interval_s < shortest_s) {
    cursor.fail("record_interval_s",
                fmt::format("gives {:g} rows; allowed: at most {:g}, so at least {} s",
                            run.duration_s / run.record_interval_s, most_recorded_rows,
                            scene::at_least(shortest_s)));
  }
}

}  // namespace

void check_solver(const TableCursor& cursor, const Variant& /*variant*/, scene::Scene& scene) {
  require_built(cursor, scene.solver);
  require_solvable(cursor, scene);
  require_load_solved(cursor, scene);
  settle_waveform(cursor, scene);
}

void settle_method(const TableCursor& cursor, scene::Scene& scene) {
  if (!cursor.has("method")) {
    scene.solver.method = scene::fastest_method(scene);
  }
}

void check_run(const TableCursor& cursor, const Variant& /*variant*/, scene::Scene& scene) {
  const scene::Run& run = scene.run;
  const std::string_view duration = cursor.given_of("duration_s", "duration_periods");
  check_work(cursor, duration, scene);
  check_window(cursor, cursor.given_of("window_start_s", "window_start_periods"), run, scene.drive);
  if (scene.controller) {
    check_whole_period(cursor, duration, run, *scene.drive);
  } else if (run.start == scene::Start::steady) {
    require_steady_conditions(cursor, scene);
  }
  check_record(cursor, scene);
}
}  // namespace sonoglide::scene_file
