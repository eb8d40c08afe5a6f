/// What a scene does not name is not in the loop that runs: each composition beside a minimal loop
/// for the same scene. Both run in turn, and must agree in every bit. Times are the shortest seen.

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "cost_by_hand.hpp"
#include "cost_composed.hpp"
#include "cost_composed_control.hpp"

namespace sonoglide::cost {
namespace {

bool same(const Result& a, const Result& b) {
  return a.displacement == b.displacement && a.velocity == b.velocity && a.friction == b.friction &&
         a.friction_integral == b.friction_integral && a.friction_work == b.friction_work &&
         a.sliding_work == b.sliding_work && a.drive_work == b.drive_work &&
         a.damping_work == b.damping_work && a.velocity_square == b.velocity_square &&
         a.displacement_square == b.displacement_square && a.drive_amplitude == b.drive_amplitude &&
         a.steps == b.steps;
}

/// Of this thread: the time in which the machine runs other programs does not count.
double processor_time_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A run of one loop of a pair: what it takes to record, and what it computes.
using Loop = std::function<Result(double* record)>;

/// Under these names tools/count_instructions finds the two loops.
[[gnu::noinline]] Result run_composed(const Loop& loop, double* record) {
  return loop(record);
}
[[gnu::noinline]] Result run_by_hand(const Loop& loop, double* record) {
  return loop(record);
}

/// One loop of a pair: its latest result and record, and its shortest time.
class Timed {
 public:
  using Runner = Result (*)(const Loop&, double*);

  Timed(Runner runner, const Loop& loop)
      : runner_(runner), loop_(loop), record_(static_cast<std::size_t>(samples_per_run)) {}

  double run() {
    const double begin_s = processor_time_s();
    result_ = runner_(loop_, record_.data());
    const double seconds = processor_time_s() - begin_s;
    shortest_s_ = std::min(shortest_s_, seconds);
    return seconds;
  }

  double ns_per_period() const { return 1e9 * shortest_s_ / periods; }
  const Result& result() const { return result_; }
  bool agrees(const Timed& other) const {
    return same(result_, other.result_) && record_ == other.record_;
  }

 private:
  Runner runner_;
  const Loop& loop_;
  std::vector<double> record_;
  Result result_;
  double shortest_s_ = std::numeric_limits<double>::infinity();
};

/// Either loop is the first of a pair in turn.
void compare(benchmark::State& state, const Loop& composed, const Loop& by_hand) {
  Timed by_types(run_composed, composed);
  Timed by_writing(run_by_hand, by_hand);
  bool types_first = true;
  for (auto _ : state) {
    const double first_s = (types_first ? by_types : by_writing).run();
    const double second_s = (types_first ? by_writing : by_types).run();
    state.SetIterationTime(types_first ? first_s : second_s);
    types_first = !types_first;
    if (by_types.result().steps == 0 || !by_types.agrees(by_writing)) {
      state.SkipWithError("the two loops do not agree");
      return;
    }
  }
  state.counters["composed_ns"] = by_types.ns_per_period();
  state.counters["by_hand_ns"] = by_writing.ns_per_period();
  state.counters["ratio"] = by_types.ns_per_period() / by_writing.ns_per_period();
  state.counters["steps"] = static_cast<double>(by_types.result().steps) / periods;
}

template <class Solver>
void count_bytes(benchmark::State& state) {
  state.counters["model_bytes"] = sizeof(typename Solver::Model);
  state.counters["solver_bytes"] = sizeof(Solver);
  state.counters["state_bytes"] = sizeof(plant::State<double>);
}

template <class Solver, class Account = plant::NoAccount>
void pair(benchmark::State& state, Scene scene, Result (*by_hand)(const Scene&)) {
  compare(
      state, [&](double* /*record*/) { return run<Solver, Account>(scene); },
      [&](double* /*record*/) { return by_hand(scene); });
  count_bytes<Solver>(state);
}

template <class Solver, class Account>
void recorded_pair(benchmark::State& state, Scene scene, Result (*by_hand)(const Scene&, double*)) {
  compare(
      state, [&](double* record) { return run_recorded<Solver, Account>(scene, record); },
      [&](double* record) { return by_hand(scene, record); });
  count_bytes<Solver>(state);
}

template <class Solver, class Number>
void controlled_pair(benchmark::State& state, Result (*by_hand)(const Scene&)) {
  compare(
      state, [](double* /*record*/) { return run_controlled<Solver, Number>(controlled); },
      [&](double* /*record*/) { return by_hand(controlled); });
  count_bytes<Solver>(state);
  state.counters["controller_bytes"] = sizeof(ControllerOf<Number>);
}

template <class Law, class Damping, class Drive>
using TaylorOf = Taylor<plant::Model<Law, Damping, Drive, plant::ConstantSliding>>;
template <class Law, class Damping, class Drive>
using Rk4Of = plant::Rk4<plant::Model<Law, Damping, Drive, plant::ConstantSliding>>;

using plant::EnergyAccount;
using plant::MeanFriction;
using plant::NoAccount;

void register_rung(const char* name, void (*rung)(benchmark::State&)) {
  benchmark::RegisterBenchmark(name, rung)->UseManualTime();
}

bool register_taylor() {
  const auto add = register_rung;
  add("taylor/free", [](benchmark::State& s) {
    pair<TaylorOf<Free, Undamped, NoDrive>>(s, undriven, by_hand::free_oscillator);
  });
  add("taylor/damped", [](benchmark::State& s) {
    pair<TaylorOf<Free, Damped, NoDrive>>(s, undriven, by_hand::damped_oscillator);
  });
  add("taylor/driven", [](benchmark::State& s) {
    pair<TaylorOf<Free, Undamped, CosineDrive>>(s, table_1, by_hand::driven_oscillator);
  });
  add("taylor/driven_damped", [](benchmark::State& s) {
    pair<TaylorOf<Free, Damped, CosineDrive>>(s, table_1, by_hand::driven_damped_oscillator);
  });
  add("taylor/coulomb", [](benchmark::State& s) {
    pair<TaylorOf<Coulomb, Undamped, CosineDrive>>(s, table_1, by_hand::coulomb);
  });
  add("taylor/dahl_undriven", [](benchmark::State& s) {
    pair<TaylorOf<Dahl, Undamped, NoDrive>>(s, undriven, by_hand::undriven_dahl);
  });
  add("taylor/dahl", [](benchmark::State& s) {
    pair<TaylorOf<Dahl, Undamped, CosineDrive>>(s, table_1, by_hand::dahl);
  });
  add("taylor/dahl_damped", [](benchmark::State& s) {
    pair<TaylorOf<Dahl, Damped, CosineDrive>>(s, table_1, by_hand::damped_dahl);
  });
  add("taylor/dahl+mean_friction", [](benchmark::State& s) {
    pair<TaylorOf<Dahl, Undamped, CosineDrive>, MeanFriction<double>>(s, table_1,
                                                                      by_hand::dahl_mean_friction);
  });
  add("taylor/dahl+energy", [](benchmark::State& s) {
    pair<TaylorOf<Dahl, Undamped, CosineDrive>, EnergyAccount<double>>(s, table_1,
                                                                       by_hand::dahl_energy);
  });
  add("taylor/dahl+record", [](benchmark::State& s) {
    recorded_pair<TaylorOf<Dahl, Undamped, CosineDrive>, NoAccount>(s, table_1,
                                                                    by_hand::dahl_recorded);
  });
  add("taylor/everything", [](benchmark::State& s) {
    recorded_pair<TaylorOf<Dahl, Damped, CosineDrive>, EnergyAccount<double>>(s, table_1,
                                                                              by_hand::everything);
  });
  return true;
}

bool register_control() {
  using Plant = TaylorOf<Dahl, Undamped, CosineDrive>;
  register_rung("taylor/controlled_float32", [](benchmark::State& s) {
    controlled_pair<Plant, float>(s, by_hand::controlled_float32);
  });
  register_rung("taylor/controlled_q31", [](benchmark::State& s) {
    controlled_pair<Plant, numeric::Q31<numeric::Saturating>>(s, by_hand::controlled_q31);
  });
  return true;
}

bool register_rk4() {
  const auto add = register_rung;
  add("rk4/free", [](benchmark::State& s) {
    pair<Rk4Of<Free, Undamped, NoDrive>>(s, undriven, by_hand::rk4_free_oscillator);
  });
  add("rk4/damped", [](benchmark::State& s) {
    pair<Rk4Of<Free, Damped, NoDrive>>(s, undriven, by_hand::rk4_damped_oscillator);
  });
  add("rk4/driven", [](benchmark::State& s) {
    pair<Rk4Of<Free, Undamped, CosineDrive>>(s, table_1, by_hand::rk4_driven_oscillator);
  });
  add("rk4/driven_damped", [](benchmark::State& s) {
    pair<Rk4Of<Free, Damped, CosineDrive>>(s, table_1, by_hand::rk4_driven_damped_oscillator);
  });
  add("rk4/coulomb", [](benchmark::State& s) {
    pair<Rk4Of<Coulomb, Undamped, CosineDrive>>(s, table_1, by_hand::rk4_coulomb);
  });
  add("rk4/dahl_undriven", [](benchmark::State& s) {
    pair<Rk4Of<Dahl, Undamped, NoDrive>>(s, undriven, by_hand::rk4_undriven_dahl);
  });
  add("rk4/dahl", [](benchmark::State& s) {
    pair<Rk4Of<Dahl, Undamped, CosineDrive>>(s, table_1, by_hand::rk4_dahl);
  });
  add("rk4/dahl_damped", [](benchmark::State& s) {
    pair<Rk4Of<Dahl, Damped, CosineDrive>>(s, table_1, by_hand::rk4_damped_dahl);
  });
  add("rk4/dahl+energy", [](benchmark::State& s) {
    pair<Rk4Of<Dahl, Undamped, CosineDrive>, EnergyAccount<double>>(s, table_1,
                                                                    by_hand::rk4_dahl_energy);
  });
  return true;
}

const bool taylor_registered = register_taylor();
const bool control_registered = register_control();
const bool rk4_registered = register_rk4();

}  // namespace
}  // namespace sonoglide::cost
