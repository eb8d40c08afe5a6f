/// Reversals of the sliding velocity, of the solvers that locate them: their number, and the
/// degenerate ones.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "firmware/plant/rk4/rk4.hpp"
#include "firmware/plant/rk4/rk4_event.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::reversal_test {
namespace {

using Contact = DahlModel<double>;
using Taylor = EventTaylor<Contact, 12>;

/// No reaction of friction and no spring: from rest v = a sin(tau), V = r + a sin(tau).
const Contact prescribed = Case().contact_stiffness(0.5);

/// smallest_excess: of the vibration over a slide against it, with a pair of reversals 2 sqrt(2
/// excess) apart, for Runge-Kutta down to a thirty-fifth of the step.
struct ByTaylor {
  using Solver = Taylor;
  static constexpr const char* name = "Taylor";
  static constexpr double setting = 1e-12;
  static constexpr double smallest_excess = 1e-10;
};
struct ByRk4Event {
  using Solver = Rk4Event<Contact>;
  static constexpr const char* name = "Rk4Event";
  static constexpr double setting = 0.1;
  static constexpr double smallest_excess = 1e-6;
};

template <class Method>
class Reversals : public testing::Test {
 protected:
  static std::uint64_t in(const Course& course) {
    auto solver = configured<typename Method::Solver>(prescribed, Method::setting);
    State<double> state;
    NoAccount account;
    EXPECT_EQ(advance(solver, course, state, account).error, Error::none);
    return solver.cost().events;
  }
  static std::uint64_t in_ten_periods(double drive_amplitude, double sliding_velocity) {
    return in(lasting(20.0 * pi).driven(drive_amplitude).sliding(sliding_velocity));
  }
};

struct MethodName {
  template <class Method>
  static std::string GetName(int /*index*/) {
    return Method::name;
  }
};
using Methods = testing::Types<ByTaylor, ByRk4Event>;
TYPED_TEST_SUITE(Reversals, Methods, MethodName);

TYPED_TEST(Reversals, TwoInEachPeriodOfAVibrationThatIsFaster) {
  for (const double r : {0.5, -0.5, 0.01, -0.99}) {
    EXPECT_EQ(this->in_ten_periods(1.0, r), 20U) << r;
  }
}

TYPED_TEST(Reversals, NoneWhereTheVibrationIsSlower) {
  for (const double r : {1.0001, 1.001, -7.0}) {
    EXPECT_EQ(this->in_ten_periods(1.0, r), 0U) << r;
  }
  EXPECT_EQ(this->in_ten_periods(0.0, 0.5), 0U);
}

TYPED_TEST(Reversals, APairCloseTogetherIsNotSkipped) {
  for (double excess = 1e-2; excess > 0.9 * TypeParam::smallest_excess; excess /= 10.0) {
    EXPECT_EQ(this->in_ten_periods(1.0, 1.0 - excess), 20U) << excess;
    EXPECT_EQ(this->in_ten_periods(1.0, excess - 1.0), 20U) << excess;
  }
}

/// V = a sin(tau) begins at rest, and V = -1 + 1.3 tau turns once.
TYPED_TEST(Reversals, BesideRest) {
  for (const double a : {1.0, -1.0}) {
    EXPECT_EQ(this->in(lasting(1.0).driven(a)), 0U);
    EXPECT_EQ(this->in(lasting(2.5).sliding(-a).accelerating(1.3 * a)), 1U);
  }
}

TEST(ReversalByTaylor, GrazingEnds) {
  const Contact stiffer = Case().contact_stiffness(2.0);
  auto solver = configured<Taylor>(stiffer, 1e-12);
  State<double> state;
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, 20, 1.0, 1.0, state, account), Error::none);
  EXPECT_GE(solver.cost().steps, 20U);
  EXPECT_LT(solver.cost().steps, 1000U);
  EXPECT_NEAR(state.friction, 1.0, 1e-12);
  // V >= 0 throughout: u = r tau + 1 - cos(tau), e = exp(-2 u).
  const double touch = 1.5 * pi;
  const State<double> at_touch = advanced(solver, lasting(touch).driven(0.01).sliding(0.01), {});
  EXPECT_NEAR(at_touch.friction, 1.0 - std::exp(-2.0 * 0.01 * (touch + 1.0)), 1e-12);
}

TEST(ReversalByTaylor, AStiffContactAtRestTakesFewSteps) {
  auto solver = configured<Taylor>(Case().contact_stiffness(1e4).friction_force(0.3), 1e-12);
  const State<double> end = advanced(solver, lasting(50.0), {});
  EXPECT_EQ(end.displacement, 0.0);
  EXPECT_EQ(end.friction, 0.0);
  EXPECT_GE(solver.cost().steps, 1U);
  EXPECT_LT(solver.cost().steps, 200U);
}

/// A stuck contact that rings many times in each carrier period.
TEST(ReversalByTaylor, ManyInEachPeriodAgreeWithSmallFixedSteps) {
  const Contact model = Case().contact_stiffness(3e3).friction_force(0.9).stiffness(0.1);
  const Interval<double> interval = lasting(2.0 * pi).driven(0.4);
  const State<double> start = {0.0, 0.01, 0.0};
  auto taylor = configured<EventTaylor<Contact, 16>>(model, 1e-14);
  auto rk4 = configured<Rk4<Contact>>(model, 1e-5);
  State<double> exact = start;
  State<double> fixed = start;
  MeanFriction<double> exact_account;
  MeanFriction<double> fixed_account;
  EXPECT_EQ(advance(taylor, interval, exact, exact_account).error, Error::none);
  EXPECT_EQ(advance(rk4, interval, fixed, fixed_account).error, Error::none);
  EXPECT_GT(taylor.cost().events, 50U);
  EXPECT_LE(taylor.cost().events, 110U);  // 2 sqrt(beta kappa) = 104 by the ringing
  EXPECT_NEAR(exact.displacement, fixed.displacement, 1e-9);
  EXPECT_NEAR(exact.friction, fixed.friction, 1e-5);
  EXPECT_NEAR(exact_account.friction_integral, fixed_account.friction_integral, 1e-6);
}

}  // namespace
}  // namespace sonoglide::plant::reversal_test
