/// Orders of convergence, and what the tolerance delivers.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::convergence_test {
namespace {

using Contact = DampedDahlModel<double>;

const Contact soft = Case().contact_stiffness(0.9).friction_force(0.3).damping(0.2).stiffness(0.6);
const State<double> start = {0.2, -0.1, 0.3};

/// Equal pieces of an interval in which the sliding velocity keeps its sign.
template <class Solver>
State<double> in_pieces(int pieces, double setting) {
  auto solver = configured<Solver>(soft, setting);
  State<double> state = start;
  const double length = 4.0 / pieces;
  for (int i = 0; i < pieces; ++i) {
    state = advanced(solver, lasting(length).from_phase(0.3 + i * length).driven(0.7).sliding(3.0),
                     state);
  }
  return state;
}

double distance(const State<double>& a, const State<double>& b) {
  return std::abs(a.displacement - b.displacement) + std::abs(a.velocity - b.velocity) +
         std::abs(a.friction - b.friction);
}

State<double> exact() {
  return in_pieces<EventTaylor<Contact, 16>>(40, 1e-16);
}

TEST(Convergence, Rk4IsOfFourthOrderBetweenReversals) {
  const double coarse = distance(in_pieces<Rk4<Contact>>(1, 0.02), exact());
  const double fine = distance(in_pieces<Rk4<Contact>>(1, 0.01), exact());
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.1);
}

template <std::size_t Order>
double taylor_order(int pieces) {
  using Solver = EventTaylor<Contact, Order>;
  const double one_step_a_piece = 1e20;
  const double coarse = distance(in_pieces<Solver>(pieces, one_step_a_piece), exact());
  const double fine = distance(in_pieces<Solver>(2 * pieces, one_step_a_piece), exact());
  return std::log2(coarse / fine);
}

/// One more than the order of the force, whose integral the velocity is.
TEST(Convergence, TaylorHasTheOrderOfItsSeriesBetweenReversals) {
  EXPECT_NEAR(taylor_order<4>(40), 5.0, 0.4);
  EXPECT_NEAR(taylor_order<8>(20), 9.0, 0.8);
  EXPECT_NEAR(taylor_order<12>(12), 13.0, 1.2);
}

/// Mean friction over many reversals.
template <class Solver>
double mean_friction(const Contact& model, double setting) {
  auto solver = configured<Solver>(model, setting);
  State<double> state;
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, 10, 1.0, 0.3, state, account), Error::none);
  return account.friction_integral / (20.0 * pi);
}

TEST(Convergence, TaylorDeliversItsToleranceAcrossReversals) {
  for (const double kappa : {0.4, 30.0, 3000.0, 1e6, 1e9}) {
    const Contact model =
        Case().contact_stiffness(kappa).friction_force(0.05).damping(0.1).stiffness(0.05);
    const double reference = mean_friction<EventTaylor<Contact, 16>>(model, 1e-15);
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      const double loose = mean_friction<EventTaylor<Contact, 8>>(model, tolerance);
      const double usual = mean_friction<EventTaylor<Contact, 12>>(model, tolerance);
      EXPECT_NEAR(loose, reference, 10.0 * tolerance) << kappa;
      EXPECT_NEAR(usual, reference, 10.0 * tolerance) << kappa;
    }
  }
}

TEST(Convergence, Rk4TendsToTheSameMeanAcrossReversalsInSecondOrder) {
  const double reference = mean_friction<EventTaylor<Contact, 16>>(soft, 1e-15);
  EXPECT_NEAR(mean_friction<Rk4<Contact>>(soft, 0.01), reference, 1e-5);
  EXPECT_NEAR(mean_friction<Rk4<Contact>>(soft, 0.001), reference, 1e-7);
  EXPECT_NEAR(mean_friction<Rk4<Contact>>(soft, 0.0001), reference, 1e-9);
}

TEST(Convergence, Rk4TendsToTheCoulombMeanInFirstOrder) {
  using Coulomb = CoulombModel<double>;
  auto solver = configured<Rk4<Coulomb>>(Case(), 1e-3);
  State<double> state = {-1.0, 0.0, 0.0};
  MeanFriction<double> account;
  EXPECT_EQ(run_periods(solver, 10, 1.0, 0.5, state, account), Error::none);
  EXPECT_NEAR(account.friction_integral / (20.0 * pi), 1.0 / 3.0, 1e-3);
}

}  // namespace
}  // namespace sonoglide::plant::convergence_test
