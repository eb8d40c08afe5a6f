/// The splitting method's own parts: the exact flow, the path of a velocity, the arcs of friction.

#include "firmware/plant/strang/equal_step_strang.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "motion.hpp"

namespace sonoglide::plant {
namespace {

static_assert(Strang<DahlModel<double>>::solves<friction::Dahl<double>>);
static_assert(Strang<DahlModel<double>>::solves<friction::None<double>>);
static_assert(!Strang<DahlModel<double>>::solves<friction::Coulomb<double>>);

/// exp of {{0, 1}, {-k, -d}} time, less the unit matrix: series at time / 2^20, squared.
std::array<std::array<long double, 2>, 2> growth_in_long_double(double stiffness, double damping,
                                                                double time) {
  using Matrix = std::array<std::array<long double, 2>, 2>;
  const auto times = [](const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 4; ++i) {
      c[i / 2][i % 2] = a[i / 2][0] * b[0][i % 2] + a[i / 2][1] * b[1][i % 2];
    }
    return c;
  };
  const auto k = static_cast<long double>(stiffness);
  const auto d = static_cast<long double>(damping);
  const long double s = std::ldexp(static_cast<long double>(time), -20);
  const Matrix m = {{{0.0L, s}, {-k * s, -d * s}}};
  Matrix growth = m;
  Matrix term = m;
  for (int n = 2; n < 20; ++n) {
    term = times(term, m);
    for (std::size_t i = 0; i < 4; ++i) {
      term[i / 2][i % 2] /= n;
      growth[i / 2][i % 2] += term[i / 2][i % 2];
    }
  }
  for (int i = 0; i < 20; ++i) {
    const Matrix square = times(growth, growth);
    for (std::size_t j = 0; j < 4; ++j) {
      growth[j / 2][j % 2] = 2.0L * growth[j / 2][j % 2] + square[j / 2][j % 2];
    }
  }
  return growth;
}

TEST(GrowthMatrix, IsTheExponentialLessOne) {
  for (const double k : {0.0, 1.0, 0.0467907, 1e4, -2.0}) {
    for (const double d : {0.0, 0.01, 2.0, 50.0, 1e4}) {
      for (const double t : {1e-6, 0.01, 0.5, 3.0}) {
        const auto exact = growth_in_long_double(k, d, t);
        const auto found = numeric::growth_matrix<double, 2>({{{0.0, 1.0}, {-k, -d}}}, t);
        double largest = 1.0;
        for (std::size_t i = 0; i < 4; ++i) {
          const double identity = i == 0 || i == 3 ? 1.0 : 0.0;
          largest =
              std::max(largest, std::abs(identity + static_cast<double>(exact[i / 2][i % 2])));
        }
        const double norm = t * std::max(1.0, std::abs(k) + d);
        const double doublings = std::max(0.0, std::floor(std::log2(norm)) + 2.0);
        const double bound =
            64.0 * std::numeric_limits<double>::epsilon() * (1.0 + doublings) * largest;
        for (std::size_t i = 0; i < 4; ++i) {
          const auto expected = static_cast<double>(exact[i / 2][i % 2]);
          EXPECT_NEAR(found[i / 2][i % 2], expected, bound) << k << ' ' << d << ' ' << t;
        }
      }
    }
  }
}

TEST(GrowthMatrix, KeepsTheDigitsOfASmallGrowth) {
  const double t = 1e-7;
  const auto growth = numeric::growth_matrix<double, 2>({{{0.0, 1.0}, {-4.0, 0.0}}}, t);
  EXPECT_NEAR(growth[0][0] / (-2.0 * std::sin(t) * std::sin(t)), 1.0, 1e-14);
  EXPECT_NEAR(growth[0][1] / (0.5 * std::sin(2.0 * t)), 1.0, 1e-15);
}

/// A quartic by its values, for the path to find again.
VelocityPath<double> path_through(const std::array<double, 5>& p, double length) {
  const auto end = [&](double x) {
    return PathEnd<double>{(((p[4] * x + p[3]) * x + p[2]) * x + p[1]) * x + p[0],
                           (((4.0 * p[4] * x + 3.0 * p[3]) * x + 2.0 * p[2]) * x + p[1]) / length};
  };
  const double mean = p[0] + p[1] / 2.0 + p[2] / 3.0 + p[3] / 4.0 + p[4] / 5.0;
  return {end(0.0), end(1.0), mean, length};
}

TEST(VelocityPath, IsTheQuarticThroughItsEnds) {
  const std::array<double, 5> p = {0.3, -1.0, 0.7, 2.0, -1.6};
  const VelocityPath<double> path = path_through(p, 0.4);
  for (const double x : {0.0, 0.2, 0.5, 1.0}) {
    EXPECT_NEAR(path.velocity(x), (((p[4] * x + p[3]) * x + p[2]) * x + p[1]) * x + p[0], 1e-14);
    EXPECT_NEAR(path.displacement(x),
                0.4 * x * ((((p[4] / 5 * x + p[3] / 4) * x + p[2] / 3) * x + p[1] / 2) * x + p[0]),
                1e-14);
  }
  EXPECT_NEAR(path.displacement(), path.displacement(1.0), 1e-15);
}

/// (x - a)(x - b)(x - c)(x - d) reverses where its roots are, those in the step.
RC_GTEST_PROP(VelocityPath, FindsEveryReversal, ()) {
  std::array<double, 5> p = {1.0, 0.0, 0.0, 0.0, 0.0};
  std::vector<double> inside;
  double root = -0.50005;
  for (int n = 0; n < 4; ++n) {
    root += *rc::gen::inRange(1, 800) * 1e-3;
    for (std::size_t i = 4; i > 0; --i) {
      p[i] = p[i - 1] - root * p[i];
    }
    p[0] *= -root;
    if (root > 0.0 && root < 1.0) {
      inside.push_back(root);
    }
  }
  const Reversals<double> found = path_through(p, 1.0).reversals();
  RC_ASSERT(found.count == inside.size());
  for (std::size_t i = 0; i < found.count; ++i) {
    RC_ASSERT(std::abs(found.at[i] - inside[i]) < 1e-7);
  }
}

TEST(VelocityPath, ARootWhereThePieceIsHalvedIsNotLost) {
  // (x - 1/4)(x - 1/2)(x - 3/4)
  const Reversals<double> found = path_through({-0.09375, 0.6875, -1.5, 1.0, 0.0}, 1.0).reversals();
  ASSERT_EQ(found.count, 3U);
  EXPECT_NEAR(found.at[0], 0.25, 1e-9);
  EXPECT_NEAR(found.at[1], 0.50, 1e-9);
  EXPECT_NEAR(found.at[2], 0.75, 1e-9);
}

TEST(VelocityPath, FromRestItGoesWhereItGoes) {
  EXPECT_EQ(path_through({0.0, 0.0, -1.0, 0.0, 0.0}, 1.0).first_direction(), -1.0);
  EXPECT_EQ(path_through({0.0, 0.0, 0.0, 0.0, 0.0}, 1.0).first_direction(), 0.0);
  const Reversals<double> found = path_through({0.0, 1.0, -2.0, 0.0, 0.0}, 1.0).reversals();
  ASSERT_EQ(found.count, 1U);
  EXPECT_NEAR(found.at[0], 0.5, 1e-12);
}

/// V = 1 - 2 x over a step of length 1: out and back by a quarter.
TEST(FrictionArcs, FollowTheLawOutAndBack) {
  for (const double kappa : {1e-6, 0.5, 20.0, 1e5}) {
    const friction::Dahl<double> law = {kappa};
    const VelocityPath<double> path = path_through({1.0, -2.0, 0.0, 0.0, 0.0}, 1.0);
    const FrictionArcs<friction::Dahl<double>> arcs(law, path, 1.0, 0.0);
    const double out = -std::expm1(-0.25 * kappa);
    EXPECT_EQ(arcs.reversals(), 1U);
    EXPECT_NEAR(arcs.friction(0.5), out, 1e-14);
    EXPECT_NEAR(arcs.end_friction(), -1.0 + (1.0 + out) * std::exp(-0.25 * kappa), 1e-14);
  }
}

/// The integral of phi = 1 - exp(-kappa x) over a steady slide, however stiff.
TEST(FrictionArcs, IntegralOfASaturatingArc) {
  for (const double kappa : {0.01, 0.3, 1.0, 10.0, 1e3, 1e7}) {
    const friction::Dahl<double> law = {kappa};
    const VelocityPath<double> path = path_through({1.0, 0.0, 0.0, 0.0, 0.0}, 1.0);
    const FrictionArcs<friction::Dahl<double>> arcs(law, path, 1.0, 0.0);
    const double missing = -std::expm1(-kappa) / kappa;
    EXPECT_NEAR(arcs.integral(1.0, 0.0), 1.0 - missing, 1e-3 * missing);
    const double first_moment = 0.5 - (missing - std::exp(-kappa)) / kappa;
    EXPECT_NEAR(arcs.integral(0.0, 1.0), first_moment, 1e-3 * missing);
  }
}

/// What is missing from saturation is small, its rate in a very stiff contact is not.
TEST(FrictionArcs, IntegralOfAnArcThatIsAllButSaturated) {
  const VelocityPath<double> path = path_through({1.0, 0.0, 0.0, 0.0, 0.0}, 1.0);
  for (const double kappa : {1e3, 1e12, 1e30}) {
    for (const double missing : {1e-5, 1e-12, 0.0}) {
      const friction::Dahl<double> law = {kappa};
      const FrictionArcs<friction::Dahl<double>> arcs(law, path, 1.0, 1.0 - missing);
      EXPECT_NEAR(arcs.integral(1.0, 0.0), 1.0, missing / kappa + 3e-11);
    }
  }
}

/// A step far too long for the ringing is cut to one that is stable.
TEST(StrangStuck, RingsAsASpringHoweverLongTheStep) {
  const double kappa = 1e4;
  const double beta = 0.5;
  const double w = std::sqrt(beta * kappa);
  auto solver = configured<Strang<DahlModel<double>>>({{{kappa}, beta, 1.0}, {}, 0.0}, 1.0);
  State<double> state = {1e-11, 0.0, kappa * 1e-11};
  double largest = 0.0;
  NoAccount account;
  auto watch = [&](const auto& step) {
    largest = std::fmax(largest, std::abs(step.at(step.length()).displacement));
  };
  ASSERT_EQ(solver.advance({0.0, 200.0 * pi / w, 0.0, 0.0, 0.0}, state, account, watch).error,
            Error::none);
  EXPECT_GT(largest, 0.8e-11);
  EXPECT_LT(largest, 1.2e-11);
  EXPECT_GE(solver.cost().steps, 600U);
}

/// The flow is computed anew for every length of step, and for no other reason.
TEST(StrangFlow, IntervalsOfAnyLengthJoin) {
  using Free = Model<friction::None<double>, Undamped<double>, CosineDrive>;
  const Free model = {{}, {}, 0.7};
  auto solver = configured<Strang<Free>>(model, 0.5);
  State<double> state;
  double phase = 0.0;
  for (const double part : {0.3, 2.0, 0.3, 0.0, 1e-9, 1.4}) {
    state = advanced(solver, {phase, part, 1.0, 0.0, 0.0}, state);
    phase += part;
  }
  const double w = std::sqrt(0.7);
  EXPECT_NEAR(state.displacement, (std::cos(phase) - std::cos(w * phase)) / (0.7 - 1.0), 1e-14);
}

/// Mean friction of one period of Table 1, whose drive changes every 200.
template <class Scalar>
class Table1Plant {
 public:
  explicit Table1Plant(double steps_per_period) {
    const DahlModel<Scalar> model{
        {{number(1.8417)}, number(1.0696e-5), Scalar(1)}, {}, number(0.04679)};
    solver_.configure(model, number(2.0 * pi / steps_per_period));
  }

  double mean_friction(int period, double full_drive) {
    const double amplitude = full_drive * (period / 200 % 2 == 0 ? 0.4 : 0.6) * 1.04679;
    MeanFriction<Scalar> account;
    run_periods(solver_, 1, number(amplitude), number(0.10984), state_, account);
    return static_cast<double>(account.friction_integral) / (2.0 * pi);
  }

 private:
  static Scalar number(double value) { return static_cast<Scalar>(value); }

  Strang<DahlModel<Scalar>> solver_;
  State<Scalar> state_;
};

TEST(StrangFloat, EightStepsKeepTheFrictionRatioOfTable1) {
  for (const double full_drive : {0.1, 0.25, 0.5, 0.75, 1.0}) {
    Table1Plant<float> plant(8.0);
    Table1Plant<double> exact(24.0);
    for (int k = 0; k < 1600; ++k) {
      ASSERT_NEAR(plant.mean_friction(k, full_drive), exact.mean_friction(k, full_drive), 6e-4)
          << full_drive << ", carrier period " << k;
    }
  }
}

}  // namespace
}  // namespace sonoglide::plant
