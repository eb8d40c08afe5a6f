/// Vibration normal to the surface: closed-form ratio, a contact that opens, energy, and the slider
/// followed in short steps.

#include "firmware/friction/normal_coulomb.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware/friction/normal_vibration_ratio.hpp"
#include "random.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::normal_coulomb_test {
namespace {

using Law = friction::NormalCoulomb<double>;
using PlantModel = Model<Law, Damped<double>, CosineDrive>;
using Taylor = EventTaylor<PlantModel, 16>;

PlantModel model_of(const Law& law, double friction_force = 0.0, double stiffness = 0.0,
                    double damping = 0.0) {
  return {{law, friction_force}, {damping}, stiffness};
}

/// Mean friction over a period of y = -cos tau, which begins where a slipping contact is at its
/// lowest limit.
template <class Solver>
double prescribed_ratio(Solver solver, const Law& law, double velocity_ratio) {
  State<double> state = {-1.0, 0.0, std::copysign(law.limit(-1.0), velocity_ratio)};
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, 1, 1.0, velocity_ratio, state, account), Error::none);
  return account.friction_integral / (2.0 * pi);
}

TEST(NormalCoulomb, MeanUnderPrescribedVibrationIsTheClosedForm) {
  for (const double amplitude : {0.05, 0.4, 0.99}) {
    for (const double s : {0.003, 0.1, 0.3, 0.6, 0.9, 0.999, 1.0, 1.7}) {
      const double stiffness = 20.0;
      const double r = s * amplitude / stiffness;
      const Law law = {stiffness, amplitude};
      const auto solver = configured<Taylor>(model_of(law), 1e-13);
      const double expected = friction::normal_vibration_ratio(amplitude, s);
      EXPECT_NEAR(prescribed_ratio(solver, law, r), expected, 1e-12) << amplitude << ' ' << s;
      EXPECT_NEAR(prescribed_ratio(solver, law, -r), -expected, 1e-12) << amplitude << ' ' << s;
    }
  }
}

TEST(NormalCoulomb, ToleranceIsThatOfTheMeanFriction) {
  const Law law = {20.0, 0.7};
  const double expected = friction::normal_vibration_ratio(0.7, 0.4);
  const auto mean = [&](const auto& solver) {
    return prescribed_ratio(solver, law, 0.4 * 0.7 / 20.0);
  };
  const PlantModel model = model_of(law);
  EXPECT_NEAR(mean(configured<EventTaylor<PlantModel, 8>>(model, 1e-4)), expected, 1e-4);
  EXPECT_NEAR(mean(configured<EventTaylor<PlantModel, 8>>(model, 1e-6)), expected, 1e-6);
  EXPECT_NEAR(mean(configured<EventTaylor<PlantModel, 12>>(model, 1e-8)), expected, 1e-8);
  EXPECT_NEAR(mean(configured<EventTaylor<PlantModel, 16>>(model, 1e-10)), expected, 1e-10);
}

TEST(NormalCoulomb, MeanInSinglePrecision) {
  using Single = Model<friction::NormalCoulomb<float>, Damped<float>, CosineDrive>;
  auto solver = configured<EventTaylor<Single, 8>>({{{20.0F, 0.7F}, 0.0F}, {0.0F}, 0.0F}, 1e-6F);
  State<float> state = {-1.0F, 0.0F, 0.0F};
  MeanFriction<float> settling;
  MeanFriction<float> account;
  EXPECT_EQ(run_periods(solver, 2, 1.0F, 0.014F, state, settling), Error::none);
  EXPECT_EQ(run_periods(solver, 1, 1.0F, 0.014F, state, account), Error::none);
  EXPECT_NEAR(static_cast<double>(account.friction_integral) / (2.0 * pi),
              friction::normal_vibration_ratio(0.7, 0.4), 5e-6);
}

/// Where it begins to stick and where it slips again; nothing else is stopped at.
TEST(NormalCoulomb, FindsTwoCornersInAPeriod) {
  auto solver = configured<Taylor>(model_of({20.0, 0.7}), 1e-10);
  State<double> state = {-1.0, 0.0, 0.3};
  NoAccount account;
  EXPECT_EQ(run_periods(solver, 50, 1.0, 0.014, state, account), Error::none);
  EXPECT_GE(solver.cost().events, 99U);
  EXPECT_LE(solver.cost().events, 101U);
}

/// At its limit and pulled by nothing: to slip or to stick is the same.
TEST(NormalCoulomb, StandsStillWhereNothingMoves) {
  auto solver = configured<Taylor>(model_of({3.0, 0.5}), 1e-12);
  const State<double> state = advanced(solver, lasting(6.0), {0.0, 0.0, 1.0});
  EXPECT_EQ(state.friction, 1.0);
  EXPECT_EQ(solver.cost().events, 0U);
}

TEST(NormalCoulomb, LeavesTheOscillatorAlone) {
  using Free = Model<friction::None<double>, Damped<double>, CosineDrive>;
  const Interval<double> interval =
      lasting(30.0).from_phase(0.3).driven(1.0).sliding(0.1).accelerating(0.01);
  auto solver = configured<Taylor>(model_of({20.0, 0.5}, 0.4, 0.2, 0.05), 1e-13);
  auto free = configured<EventTaylor<Free, 16>>({{}, {0.05}, 0.2}, 1e-13);
  const State<double> state = advanced(solver, interval, {0.4, 0.1, 0.0});
  const State<double> expected = advanced(free, interval, {0.4, 0.1, 0.0});
  EXPECT_NEAR(state.displacement, expected.displacement, 1e-12);
  EXPECT_NEAR(state.velocity, expected.velocity, 1e-12);
}

TEST(NormalCoulomb, MirroredPullIsTheMirrorImageBitForBit) {
  auto solver = configured<Taylor>(model_of({20.0, 0.5}, 0.4, 0.2, 0.05), 1e-13);
  const State<double> one =
      advanced(solver, lasting(30.0).from_phase(0.3).driven(1.0).sliding(0.1).accelerating(-0.01),
               {0.4, 0.1, 0.5});
  const State<double> other =
      advanced(solver, lasting(30.0).from_phase(0.3).driven(1.0).sliding(-0.1).accelerating(0.01),
               {0.4, 0.1, -0.5});
  EXPECT_EQ(one.velocity, other.velocity);
  EXPECT_EQ(one.friction, -other.friction);
}

/// The slider in steps so short that it need only be moved back to its limit behind each, beside
/// y = -cos tau.
struct Followed {
  double friction;
  double integral;
};
Followed follow(const Law& law, const Interval<double>& interval, double friction) {
  constexpr int steps = 2000000;
  const double step = interval.duration / steps;
  Followed followed = {friction, 0.0};
  for (int i = 0; i < steps; ++i) {
    const double middle = (i + 0.5) * step;
    const double limit = law.limit(-std::cos((i + 1) * step));
    const double r = interval.sliding_velocity + interval.sliding_acceleration * middle;
    const double before = followed.friction;
    followed.friction = std::clamp(before + law.contact_stiffness * r * step, -limit, limit);
    followed.integral += 0.5 * step * (before + followed.friction);
  }
  return followed;
}

/// Vibration that lifts the mass off the surface, a pull that turns round, and both.
TEST(NormalCoulomb, AgreesWithTheSliderFollowedInShortSteps) {
  for (const double normal : {0.3, 0.999, 1.0, 1.5, 6.0}) {
    for (const double stiffness : {0.3, 4.0, 200.0}) {
      for (const double acceleration : {0.0, -0.03}) {
        const Law law = {stiffness, normal};
        const Interval<double> interval =
            lasting(20.0).driven(1.0).sliding(0.2).accelerating(acceleration);
        auto solver = configured<Taylor>(model_of(law), 1e-12);
        State<double> state = {-1.0, 0.0, 0.0};
        MeanFriction<double> account;
        EXPECT_EQ(advance(solver, interval, state, account).error, Error::none);
        const Followed expected = follow(law, interval, 0.0);
        EXPECT_NEAR(state.friction, expected.friction, 1e-4) << normal << ' ' << stiffness;
        EXPECT_NEAR(account.friction_integral, expected.integral, 2e-4)
            << normal << ' ' << stiffness << ' ' << acceleration;
        EXPECT_GE(solver.cost().steps, 4U);
        EXPECT_LE(solver.cost().steps, 80U);
      }
    }
  }
}

RC_GTEST_PROP(NormalCoulombProperties, KeepsItsLimitBalancesItsEnergyAndIsPassive, ()) {
  const Law law = {std::pow(10.0, between(-2.0, 3.0)), between(0.01, 3.0)};
  const PlantModel model = model_of(law, between(0.0, 0.5), between(0.0, 2.0), between(0.0, 0.3));
  State<double> state = {between(-1.0, 1.0), between(-1.0, 1.0), 0.0};
  state.friction = law.limit(state.displacement) * between(-1.0, 1.0);
  const State<double> before = state;
  auto solver = configured<Taylor>(model, 1e-12);
  EnergyAccount<double> account;
  RC_ASSERT(run_periods(solver, 2, between(0.0, 2.0), between(-2.0, 2.0), state, account) ==
            Error::none);
  RC_ASSERT(std::abs(account.balance_residual(model, before, state)) < 1e-9);
  RC_ASSERT(std::abs(state.friction) <= law.limit(state.displacement));
  RC_ASSERT(solver.cost().steps < 100U);
  const auto stored = [&](const State<double>& at) {
    return at.friction * at.friction / (2.0 * law.contact_stiffness);
  };
  RC_ASSERT(account.friction_work >= stored(state) - stored(before) - 1e-9);
}

}  // namespace
}  // namespace sonoglide::plant::normal_coulomb_test
