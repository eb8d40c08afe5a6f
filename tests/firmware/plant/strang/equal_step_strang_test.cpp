/// The splitting method's own parts: the exact flow, and the arcs of friction.

#include "firmware/plant/strang/equal_step_strang.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/firmware/plant/runs/motion.hpp"
#include "tests/firmware/plant/runs/quartic_path.hpp"

namespace sonoglide::plant::equal_step_strang_test {
namespace {

static_assert(EqualStepStrang<DahlModel<double>>::solves<friction::Dahl<double>>);
static_assert(EqualStepStrang<DahlModel<double>>::solves<friction::None<double>>);
static_assert(!EqualStepStrang<DahlModel<double>>::solves<friction::Coulomb<double>>);

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
  auto solver = configured<EqualStepStrang<DahlModel<double>>>(
      Case().contact_stiffness(kappa).friction_force(beta), 1.0);
  State<double> state = {1e-11, 0.0, kappa * 1e-11};
  double largest = 0.0;
  NoAccount account;
  auto watch = [&](const auto& step) {
    largest = std::fmax(largest, std::abs(step.at(step.length()).displacement));
  };
  ASSERT_EQ(solver.advance(lasting(200.0 * pi / w), state, account, watch).error, Error::none);
  EXPECT_GT(largest, 0.8e-11);
  EXPECT_LT(largest, 1.2e-11);
  EXPECT_EQ(solver.cost().steps, 629U);  // 1 / w each
}

/// The flow is computed anew for every length of step, and for no other reason.
TEST(StrangFlow, IntervalsOfAnyLengthJoin) {
  using Free = Model<friction::None<double>, Undamped<double>, CosineDrive>;
  const Free model = {{}, {}, 0.7};
  auto solver = configured<EqualStepStrang<Free>>(model, 0.5);
  State<double> state;
  double phase = 0.0;
  for (const double part : {0.3, 2.0, 0.3, 0.0, 1e-9, 1.4}) {
    state = advanced(solver, lasting(part).from_phase(phase).driven(1.0), state);
    phase += part;
  }
  const double w = std::sqrt(0.7);
  EXPECT_NEAR(state.displacement, (std::cos(phase) - std::cos(w * phase)) / (0.7 - 1.0), 1e-14);
}

/// Mean friction of one period of Table 1 at 26.72 mm/s, whose drive changes every 200.
template <class Scalar>
class Table1Plant {
 public:
  explicit Table1Plant(double steps_per_period) {
    const DahlModel<Scalar> model = Case()
                                        .contact_stiffness(table_1.contact_stiffness)
                                        .friction_force(table_1.friction_force)
                                        .stiffness(table_1.stiffness);
    solver_.configure(model, number(2.0 * pi / steps_per_period));
  }

  double mean_friction(int period, double full_drive) {
    const double amplitude = full_drive * (period / 200 % 2 == 0 ? 0.4 : 0.6);
    MeanFriction<Scalar> account;
    run_periods(solver_, 1, number(amplitude), number(sliding), state_, account);
    return static_cast<double>(account.friction_integral) / (2.0 * pi);
  }

 private:
  static constexpr double full_drive_N = 1920.0;
  static constexpr tests::DimensionlessTable1 table_1{full_drive_N};
  static constexpr double sliding =
      0.02672 * tests::Table1::inertia_N_per_m / (full_drive_N * tests::Table1::carrier_rad_per_s);

  static Scalar number(double value) { return static_cast<Scalar>(value); }

  EqualStepStrang<DahlModel<Scalar>> solver_;
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
}  // namespace sonoglide::plant::equal_step_strang_test
