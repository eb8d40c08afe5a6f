/// A small set of the extreme cases: the solvers that promise to be safe are.

#include "host_sim/studies/stability/extremes.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>
#include <string_view>

#include "host_sim/studies/stability/random_scene.hpp"
#include "host_sim/studies/stability/report.hpp"
#include "host_sim/studies/stability/solver_list.hpp"

namespace sonoglide::stability {
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

TEST(Extremes, WhoeverTakesAToleranceKeepsTheEnergyOrDeclines) {
  for (const TriedSolver& solver : solvers()) {
    for (const ExtremeRow& row : small().rows) {
      if (row.solver == solver.name && solver.adaptive) {
        EXPECT_EQ(count(row, Verdict::wrong), 0U) << row.solver << " " << row.precision;
      }
    }
  }
}

/// Each was once handed over with an energy or a friction ratio that was off: a saturated contact
/// of enormous stiffness, a motion lost in the rounding of a displacement or of the sliding, works
/// that cancel over a period, a vibration far below its scale or below the rounding of the place
/// where a free mass stands, terms near the largest number, a stop within less of a step than the
/// quotient of two terms can tell.
TEST(Extremes, ScenesThatOnceWentWrong) {
  for (const std::uint64_t scene :
       {54U,   321U,   534U,   639U,   2669U,  3376U,  4186U,  4924U,  7090U,  9938U,
        9968U, 16202U, 34846U, 37999U, 62157U, 66241U, 72461U, 76026U, 94419U, 95313U}) {
    for (const TriedSolver& solver : solvers()) {
      if (!solver.adaptive) {
        continue;
      }
      for (const TriedPrecision& precision : solver.precisions) {
        const TrialResult result =
            precision.trial(random_scene(scene),
                            {random_scene_periods, precision.extreme_setting, extreme_step_limit});
        if (result.supported && result.error == plant::Error::none) {
          const bool is_single = precision.name == "float32";
          EXPECT_LE(result.balance_residual,
                    is_single ? allowed_residual_float32 : allowed_residual_float64)
              << scene << " " << solver.name << " " << precision.name;
          EXPECT_LE(std::abs(result.friction_ratio), is_single ? 1.0 + 1e-4 : 1.0 + 1e-9)
              << scene << " " << solver.name << " " << precision.name;
        }
      }
    }
  }
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
}  // namespace sonoglide::stability
