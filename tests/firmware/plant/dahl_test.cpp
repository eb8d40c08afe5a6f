/// Dahl contact against the exact solution in displacement and the steady friction ratios.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "firmware/numeric/lane_group.hpp"
#include "law_runs.hpp"
#include "tests/common/constants/table_1_numbers.hpp"

namespace sonoglide::plant::dahl_test {
namespace {

using Contact = DahlModel<double>;
using Taylor = EventTaylor<Contact, 16>;

TEST(DahlArc, IsExactInTheDisplacement) {
  for (const double kappa : {1e-9, 0.1, 3.0, 400.0}) {
    for (const double direction : {1.0, -1.0}) {
      for (const double sign : {1.0, -1.0}) {
        auto solver = configured<Taylor>(
            Case().contact_stiffness(kappa).friction_force(0.02).vibration_sign(sign).stiffness(
                0.7),
            1e-13);
        const double friction = 0.2;
        const State<double> end = advanced(solver,
                                           lasting(2.0)
                                               .from_phase(0.4)
                                               .driven(0.5)
                                               .sliding(5.0 * direction)
                                               .accelerating(0.3 * direction),
                                           {0.1, 0.2, friction});
        const double travel =
            direction * (5.0 * 2.0 + 0.5 * 0.3 * 4.0) + sign * (end.displacement - 0.1);
        const double deficit = (1.0 - direction * friction) * std::exp(-kappa * direction * travel);
        EXPECT_NEAR(direction * end.friction, 1.0 - deficit, 2e-14 * (1.0 + kappa * deficit));
        EXPECT_EQ(solver.cost().events, 0U);
      }
    }
  }
}

TEST(DahlArc, SmallChangesKeepTheirDigits) {
  auto solver = configured<Taylor>(Case().contact_stiffness(1e-12), 1e-13);
  const State<double> end = advanced(solver, lasting(1.0).sliding(2.0), {});
  EXPECT_NEAR(end.friction / 2e-12, 1.0, 1e-11);
}

/// phi = kappa u to first order, and the work is kappa u^2 / 2.
TEST(DahlArc, SmallWorkKeepsItsDigits) {
  for (const double kappa : {1e-12, 1e-6}) {
    auto solver = configured<Taylor>(Case().contact_stiffness(kappa), 1e-13);
    State<double> state;
    EnergyAccount<double> account;
    EXPECT_EQ(advance(solver, lasting(1.0).sliding(2.0), state, account).error, Error::none);
    EXPECT_NEAR(account.friction_work / (2.0 * kappa), 1.0 - 2.0 * kappa / 3.0, 1e-11);
  }
}

TEST(DahlArc, IsTheSameInLanes) {
  for (const double kappa : {1e-3, 0.4, 50.0}) {
    const friction::Dahl<double>::Arc arc({kappa}, -1.0, 0.3);
    for (double z = 0.0; z < 80.0; z += 0.37) {
      const std::array<double, 2> travel = {z / kappa, 0.5 * z / kappa};
      const auto found = arc.friction_along(numeric::load_group<1>(travel.data()));
      const double allowed = z < 6.0 ? 2e-13 : 1e-9;
      EXPECT_NEAR(found.part[0][0], arc.friction_after(travel[0]), allowed) << z;
      EXPECT_NEAR(found.part[0][1], arc.friction_after(travel[1]), allowed) << z;
    }
  }
}

/// Nothing but the pull moves the contact: what the pull does, friction takes.
TEST(DahlArc, MeanFrictionAgreesWithTheWorkAtAnyStiffness) {
  constexpr double tolerance = 1e-7;
  for (const double kappa : {0.1, 1.0, 7.0, 50.0, 400.0, 1e4, 1e6}) {
    auto solver = configured<EventTaylor<Contact, 12>>(Case().contact_stiffness(kappa), tolerance);
    for (const double acceleration : {0.0, 0.4, -0.2}) {
      State<double> state = {0.0, 0.0, -0.8};
      EnergyAccount<double> account;
      const Interval<double> slide = lasting(2.0).sliding(0.5).accelerating(acceleration);
      EXPECT_EQ(advance(solver, slide, state, account).error, Error::none);
      EXPECT_NEAR(account.sliding_work, account.friction_work, tolerance) << kappa;
      if (acceleration == 0.0) {
        EXPECT_NEAR(0.5 * account.friction_integral, account.friction_work, tolerance) << kappa;
      }
    }
  }
}

double periodic_ratio(double velocity_ratio, double dahl_number) {
  return prescribed_ratio(taylor(friction::Dahl<double>{dahl_number}, 1e-14), velocity_ratio, 100);
}

TEST(DahlPrescribedMotion, FrictionRatio) {
  EXPECT_NEAR(periodic_ratio(0.5, 0.404519756998724), 0.674948666956629, 1e-13);
  EXPECT_NEAR(periodic_ratio(0.1, 0.4046), 0.14875, 1e-5);
  EXPECT_NEAR(periodic_ratio(0.1, 2.023), 0.08814, 1e-5);
  EXPECT_NEAR(periodic_ratio(0.1, 10.0), 0.0661, 1e-4);
  EXPECT_NEAR(periodic_ratio(0.1, 100.0), 0.0640, 1e-4);
  EXPECT_NEAR(periodic_ratio(0.5, 2.023), 0.48927, 1e-5);
  EXPECT_NEAR(periodic_ratio(0.5, 10.0), 0.3502, 1e-4);
  EXPECT_NEAR(periodic_ratio(0.9, 0.4046), 0.97585, 1e-5);
  EXPECT_NEAR(periodic_ratio(0.9, 2.023), 0.94541, 1e-5);
  EXPECT_NEAR(periodic_ratio(0.9, 100.0), 0.7246, 1e-4);
}

TEST(DahlPrescribedMotion, StiffContactTendsToCoulomb) {
  EXPECT_NEAR(periodic_ratio(0.5, 1e6), 1.0 / 3.0, 1e-5);
}

/// Table 1 started on its steady orbit: mean over the last of 20 ms.
double table1_ratio(double force_amplitude_N, double velocity_ratio) {
  const tests::DimensionlessTable1 table_1(force_amplitude_N);
  const double amplitude = table_1.vibration;
  const Contact model = Case()
                            .contact_stiffness(table_1.contact_stiffness)
                            .friction_force(table_1.friction_force)
                            .stiffness(table_1.stiffness);
  auto solver = configured<EventTaylor<Contact, 12>>(model, 1e-8);
  State<double> state = {-amplitude, 0.0, 0.0};
  MeanFriction<double> settling;
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, 1140, 1.0, velocity_ratio * amplitude, state, settling),
            Error::none);
  EXPECT_EQ(run_periods(solver, 60, 1.0, velocity_ratio * amplitude, state, account), Error::none);
  return account.friction_integral / (120.0 * pi);
}

TEST(DahlOscillator, SteadyFrictionRatioOfTable1) {
  EXPECT_NEAR(table1_ratio(384.0, 0.5), 0.6749, 0.002);
  EXPECT_NEAR(table1_ratio(1920.0, 0.5), 0.4893, 0.002);
  EXPECT_NEAR(table1_ratio(1920.0, 0.1), 0.0881, 0.002);
}

/// A stuck contact is a spring: small vibration about it has the frequency sqrt(k + beta kappa).
TEST(DahlStuck, RingsAsASpring) {
  const double kappa = 1e4;
  const double beta = 0.5;
  const double w = std::sqrt(beta * kappa + 0.3);
  auto solver = configured<Taylor>(
      Case().contact_stiffness(kappa).friction_force(beta).stiffness(0.3), 1e-24);
  const double swing = 1e-11;
  const double duration = 200.2 * pi / w;
  const State<double> end = advanced(solver, lasting(duration), {swing, 0.0, kappa * swing});
  EXPECT_NEAR(end.displacement / swing, std::cos(w * duration), 1e-4);
  EXPECT_GE(solver.cost().events, 199U);
  EXPECT_LE(solver.cost().events, 201U);
}

}  // namespace
}  // namespace sonoglide::plant::dahl_test
