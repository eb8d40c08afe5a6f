/// A small set of the extreme cases: the solvers that promise to be safe are.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "host_sim/studies/stability/random_scene.hpp"
#include "host_sim/studies/stability/study.hpp"
#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability::extremes_test {
namespace {

constexpr std::uint64_t scenes = 300;

const Extremes& small() {
  static const Extremes result = extremes(scenes, [](double) {});
  return result;
}

std::uint64_t count(const ExtremeRow& row, Verdict verdict) {
  return row.count[static_cast<std::size_t>(verdict)];
}

TEST(Extremes, EverySolverMeetsEverySceneInBothPrecisions) {
  EXPECT_EQ(small().rows.size(), 2 * solvers().size());
  for (const ExtremeRow& row : small().rows) {
    EXPECT_EQ(std::accumulate(row.count.begin(), row.count.end(), std::uint64_t{0}), scenes)
        << row.solver;
    EXPECT_GT(count(row, Verdict::good), 0U) << row.solver;
  }
}

TEST(Extremes, NoSolverReturnsAStateThatIsNoNumberOrAFrictionAboveItsLimit) {
  for (const ExtremeRow& row : small().rows) {
    EXPECT_EQ(count(row, Verdict::silent_not_finite), 0U) << row.solver << " " << row.precision;
    EXPECT_EQ(count(row, Verdict::silent_friction_bound), 0U) << row.solver << " " << row.precision;
  }
}

/// Whoever takes a tolerance, by the names of solver and precision.
std::map<std::string, TriedPrecision> adaptive_solvers() {
  std::map<std::string, TriedPrecision> found;
  for (const TriedSolver& solver : solvers()) {
    for (const TriedPrecision& precision : solver.precisions) {
      if (solver.adaptive) {
        found.emplace(solver.name + " " + std::string(precision.name), precision);
      }
    }
  }
  return found;
}

TEST(Extremes, WhoeverTakesAToleranceKeepsTheEnergyOrDeclines) {
  const auto adaptive = adaptive_solvers();
  std::size_t checked = 0;
  for (const ExtremeRow& row : small().rows) {
    if (adaptive.count(std::string(row.solver) + " " + std::string(row.precision)) > 0) {
      EXPECT_EQ(count(row, Verdict::wrong), 0U) << row.solver << " " << row.precision;
      ++checked;
    }
  }
  EXPECT_EQ(adaptive.size(), 10U);
  EXPECT_EQ(checked, adaptive.size());
}

using Names = std::set<std::string>;

const Names strang_float64 = {"strang float64"};
const Names gauss = {"event_gauss float64", "event_gauss float32"};
const Names gauss_and_strang = {"event_gauss float64", "event_gauss float32", "strang float64",
                                "strang float32"};
const Names taylor = {"event_taylor_8 float64",  "event_taylor_8 float32",
                      "event_taylor_12 float64", "event_taylor_12 float32",
                      "event_taylor_16 float64", "event_taylor_16 float32"};
const Names all_but_strang_float32 = {
    "event_taylor_8 float64",  "event_taylor_8 float32",  "event_taylor_12 float64",
    "event_taylor_12 float32", "event_taylor_16 float64", "event_taylor_16 float32",
    "event_gauss float64",     "event_gauss float32",     "strang float64"};

/// Whoever takes a tolerance and is not named solves the scene.
struct OnceWrong {
  std::uint64_t scene;
  Names declined;     ///< with too many steps
  Names unsupported;  ///< the solver does not take the scene's law
};

/// Each was once handed over with an energy or a friction ratio that was off: a saturated contact
/// of enormous stiffness, a motion lost in the rounding of a displacement or of the sliding, works
/// that cancel over a period, a vibration far below its scale or below the rounding of the place
/// where a free mass stands, terms near the largest number, a stop within less of a step than the
/// quotient of two terms can tell.
const std::vector<OnceWrong> once_wrong = {
    {54, {}, {}},
    {321, strang_float64, {}},
    {534, {}, {}},
    {639, {}, {}},
    {2669, strang_float64, {}},
    {3376, {}, {}},
    {4186, {}, gauss_and_strang},
    {4924, {}, {}},
    {7090, {}, {}},
    {9938, {}, {}},
    {9968, all_but_strang_float32, {}},
    {16202, {}, {}},
    {34846, strang_float64, {}},
    {37999, taylor, gauss_and_strang},
    {62157, {}, gauss},
    {66241, {}, {}},
    {72461, {}, {}},
    {76026, {}, gauss_and_strang},
    {94419, all_but_strang_float32, {}},
    {95313, strang_float64, {}},
};

void expect_solved(const TrialResult& result, bool is_single) {
  EXPECT_LE(result.balance_residual,
            is_single ? allowed_residual_float32 : allowed_residual_float64);
  EXPECT_LE(std::abs(result.friction_ratio), is_single ? 1.0 + 1e-4 : 1.0 + 1e-9);
}

TEST(Extremes, ScenesThatOnceWentWrong) {
  std::size_t solved = 0;
  for (const OnceWrong& each : once_wrong) {
    Names declined;
    Names unsupported;
    for (const auto& [name, precision] : adaptive_solvers()) {
      SCOPED_TRACE(std::to_string(each.scene) + " " + name);
      const TrialResult result =
          precision.trial(random_scene(each.scene),
                          {random_scene_periods, precision.extreme_setting, extreme_step_limit});
      if (!result.supported) {
        unsupported.insert(name);
      } else if (result.error != plant::Error::none) {
        EXPECT_EQ(result.error, plant::Error::too_many_steps);
        declined.insert(name);
      } else {
        expect_solved(result, precision.name == "float32");
        ++solved;
      }
    }
    EXPECT_EQ(declined, each.declined) << each.scene;
    EXPECT_EQ(unsupported, each.unsupported) << each.scene;
  }
  EXPECT_EQ(solved, 158U);
}

/// Free masses that stand far from where displacement is counted from, and ring in a stuck contact
/// with less than its rounding: the energy alone would not show a friction ratio that is off.
TEST(Extremes, TaylorsOrdersAgreeOnMassesStuckFarFromTheOrigin) {
  for (const std::uint64_t number : {34846U, 95313U}) {
    const scene::Scene scene = random_scene(number);
    const auto ratio = [&scene](const TriedPrecision& precision, double tolerance) {
      return precision.trial(scene, {random_scene_periods, tolerance, extreme_step_limit})
          .friction_ratio;
    };
    const double exact = ratio(solvers()[2].precisions[0], 1e-14);
    for (std::size_t order = 0; order < 3; ++order) {
      const auto& [in_double, in_single] = solvers()[order].precisions;
      EXPECT_NEAR(ratio(in_double, in_double.extreme_setting), exact, 1e-10) << number;
      EXPECT_NEAR(ratio(in_single, in_single.extreme_setting), exact, 1e-6) << number;
    }
  }
}

/// Searches inside a step once went round without end in these: squares that vanish, reversals
/// whose displacement is below its rounding, a velocity that is no number.
TEST(Extremes, EveryTrialEnds) {
  for (const std::uint64_t scene : {670U, 1591U, 3039U, 10886U, 15183U}) {
    for (const TriedSolver& solver : solvers()) {
      for (const TriedPrecision& precision : solver.precisions) {
        const TrialResult result =
            precision.trial(random_scene(scene),
                            {random_scene_periods, precision.extreme_setting, extreme_step_limit});
        EXPECT_TRUE(result.finite || result.error != plant::Error::none)
            << scene << " " << solver.name << " " << precision.name;
      }
    }
  }
}

TEST(Extremes, QuantilesRise) {
  for (const ExtremeRow& row : small().rows) {
    for (std::size_t i = 1; i < row.residual.size(); ++i) {
      EXPECT_GE(row.residual[i], row.residual[i - 1]) << row.solver;
    }
    ASSERT_FALSE(row.worst.empty());
    EXPECT_LE(row.worst.front().result.balance_residual, row.residual.back()) << row.solver;
  }
}

TEST(Extremes, DoNotDependOnTheNumberOfThreads) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const Extremes alone = extremes(scenes, [](double) {});
  EXPECT_EQ(extremes_csv(alone), extremes_csv(small()));
  EXPECT_EQ(worst_csv(alone), worst_csv(small()));
}

TEST(Extremes, ProgressEndsAtOneAndNeverFalls) {
  double last = 0.0;
  extremes(20, [&last](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  });
  EXPECT_EQ(last, 1.0);
}

}  // namespace
}  // namespace sonoglide::stability::extremes_test
