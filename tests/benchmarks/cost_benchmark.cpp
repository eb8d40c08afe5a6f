/// What a scene does not name is not in the loop that runs: each composition beside a minimal loop
/// for the same scene. Both run in turn, and must agree in every bit. Times are the shortest seen.

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <type_traits>
#include <vector>

#include "cost_by_hand.hpp"
#include "cost_by_hand_rk4.hpp"
#include "cost_by_hand_taylor.hpp"
#include "cost_composed.hpp"
#include "cost_composed_control.hpp"
#include "firmware/numeric/fixed.hpp"

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

template <class Law>
constexpr by_hand::Law law_by_hand = std::is_same_v<Law, Dahl>      ? by_hand::Law::dahl
                                     : std::is_same_v<Law, Coulomb> ? by_hand::Law::coulomb
                                                                    : by_hand::Law::none;

template <class Law, class Damping, class Drive>
using ModelOf = plant::Model<Law, Damping, Drive, plant::ConstantSliding>;

/// A rung of the ladder: what is composed as types is named to the loop by hand.
template <template <class> class SolverOf, class Law, class Damping, class Drive,
          class Account = plant::NoAccount, bool recorded = false>
void rung(benchmark::State& state) {
  using Model = ModelOf<Law, Damping, Drive>;
  using Solver = SolverOf<Model>;
  static constexpr by_hand::Named named = {law_by_hand<Law>,
                                           std::is_same_v<Drive, CosineDrive>,
                                           std::is_same_v<Damping, Damped>,
                                           std::is_same_v<Account, plant::MeanFriction<double>>,
                                           std::is_same_v<Account, plant::EnergyAccount<double>>,
                                           recorded};
  Scene scene = named.driven ? table_1 : undriven;
  compare(
      state,
      [&](double* record) {
        if constexpr (recorded) {
          return run_recorded<Solver, Account>(scene, record);
        } else {
          return run<Solver, Account>(scene);
        }
      },
      [&](double* record) {
        if constexpr (std::is_same_v<Solver, Taylor<Model>>) {
          return by_hand::taylor(scene, record, named);
        } else {
          return by_hand::rk4(scene, named);
        }
      });
  count_bytes<Solver>(state);
}

template <class Number>
void controlled_rung(benchmark::State& state) {
  using Solver = Taylor<ModelOf<Dahl, Undamped, CosineDrive>>;
  compare(
      state, [](double* /*record*/) { return run_controlled<Solver, Number>(controlled); },
      [](double* /*record*/) { return by_hand::controlled<Number>(controlled); });
  count_bytes<Solver>(state);
  state.counters["controller_bytes"] = sizeof(ControllerOf<Number>);
}

const bool registered = [] {
  using plant::EnergyAccount;
  using plant::MeanFriction;
  using plant::NoAccount;
  using plant::Rk4;
  const auto add = [](const char* name, void (*rung)(benchmark::State&)) {
    benchmark::RegisterBenchmark(name, rung)->UseManualTime();
  };
  add("taylor/free", rung<Taylor, Free, Undamped, NoDrive>);
  add("taylor/damped", rung<Taylor, Free, Damped, NoDrive>);
  add("taylor/driven", rung<Taylor, Free, Undamped, CosineDrive>);
  add("taylor/driven_damped", rung<Taylor, Free, Damped, CosineDrive>);
  add("taylor/coulomb", rung<Taylor, Coulomb, Undamped, CosineDrive>);
  add("taylor/dahl_undriven", rung<Taylor, Dahl, Undamped, NoDrive>);
  add("taylor/dahl", rung<Taylor, Dahl, Undamped, CosineDrive>);
  add("taylor/dahl_damped", rung<Taylor, Dahl, Damped, CosineDrive>);
  add("taylor/dahl+mean_friction", rung<Taylor, Dahl, Undamped, CosineDrive, MeanFriction<double>>);
  add("taylor/dahl+energy", rung<Taylor, Dahl, Undamped, CosineDrive, EnergyAccount<double>>);
  add("taylor/dahl+record", rung<Taylor, Dahl, Undamped, CosineDrive, NoAccount, true>);
  add("taylor/everything", rung<Taylor, Dahl, Damped, CosineDrive, EnergyAccount<double>, true>);
  add("taylor/controlled_float32", controlled_rung<float>);
  add("taylor/controlled_q31", controlled_rung<numeric::Q31<numeric::Saturating>>);
  add("rk4/free", rung<Rk4, Free, Undamped, NoDrive>);
  add("rk4/damped", rung<Rk4, Free, Damped, NoDrive>);
  add("rk4/driven", rung<Rk4, Free, Undamped, CosineDrive>);
  add("rk4/driven_damped", rung<Rk4, Free, Damped, CosineDrive>);
  add("rk4/coulomb", rung<Rk4, Coulomb, Undamped, CosineDrive>);
  add("rk4/dahl_undriven", rung<Rk4, Dahl, Undamped, NoDrive>);
  add("rk4/dahl", rung<Rk4, Dahl, Undamped, CosineDrive>);
  add("rk4/dahl_damped", rung<Rk4, Dahl, Damped, CosineDrive>);
  add("rk4/dahl+energy", rung<Rk4, Dahl, Undamped, CosineDrive, EnergyAccount<double>>);
  return true;
}();

}  // namespace
}  // namespace sonoglide::cost
