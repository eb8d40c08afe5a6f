/// A plant whose sliding cannot change moves, bit for bit, as one whose sliding does not.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <type_traits>

#include "firmware/plant/gauss/event_gauss.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/rk4/rk4_event.hpp"
#include "firmware/plant/strang/strang.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::sliding_test {
namespace {

template <class Law, class Sliding>
using Plant = Model<Law, Damped<double>, CosineDrive, Sliding>;
using Dahl = friction::Dahl<double>;
using Coulomb = friction::Coulomb<double>;

template <class Model>
using Taylor = EventTaylor<Model, 16>;
template <class Model>
using Gauss = EventGauss<Model, 8>;

struct Motion {
  State<double> state;
  EnergyAccount<double> account;
  Cost cost;
  Error error;
};

bool same(const Motion& a, const Motion& b) {
  return a.error == b.error && a.cost.steps == b.cost.steps && a.cost.events == b.cost.events &&
         a.state.displacement == b.state.displacement && a.state.velocity == b.state.velocity &&
         a.state.friction == b.state.friction &&
         a.account.friction_integral == b.account.friction_integral &&
         a.account.friction_work == b.account.friction_work &&
         a.account.sliding_work == b.account.sliding_work &&
         a.account.drive_work == b.account.drive_work &&
         a.account.damping_work == b.account.damping_work &&
         a.account.velocity_square == b.account.velocity_square &&
         a.account.displacement_square == b.account.displacement_square;
}

/// What a case draws: numbers, and which way.
struct Drawn {
  double friction_force;
  double vibration_sign;
  double damping;
  double stiffness;
  double drive_amplitude;
  double sliding_velocity;
  State<double> state;
};

double part(double low, double high) {
  return low + (high - low) * 1e-4 * *rc::gen::inRange(0, 10001);
}

Drawn drawn() {
  return {std::pow(10.0, part(-6.0, 0.0)),
          *rc::gen::element(1.0, -1.0),
          part(0.0, 0.2),
          part(0.0, 3.0),
          part(0.1, 1.0),
          part(-1.2, 1.2),
          {part(-1.0, 1.0), part(-1.0, 1.0), part(-1.0, 1.0)}};
}

template <template <class> class Solver, class Law, class Sliding>
Motion motion(const Law& law, const Drawn& drawn, double setting) {
  auto solver = configured<Solver<Plant<Law, Sliding>>>(
      {{law, drawn.friction_force, drawn.vibration_sign}, {drawn.damping}, drawn.stiffness},
      setting);
  Motion motion = {drawn.state, {}, {}, Error::none};
  motion.error = run_periods(solver, 10, drawn.drive_amplitude, drawn.sliding_velocity,
                             motion.state, motion.account);
  motion.cost = solver.cost();
  return motion;
}

template <template <class> class Solver, class Law>
void expect_same(const Law& law, double setting) {
  const Drawn numbers = drawn();
  RC_ASSERT(same(motion<Solver, Law, ConstantSliding>(law, numbers, setting),
                 motion<Solver, Law, LinearSliding>(law, numbers, setting)));
}

Dahl any_dahl() {
  return {std::pow(10.0, part(-2.0, 1.0))};
}

RC_GTEST_PROP(ConstantSlidingTest, EventTaylorOnDahl, ()) {
  expect_same<Taylor>(any_dahl(), 1e-10);
}
RC_GTEST_PROP(ConstantSlidingTest, EventTaylorOnCoulomb, ()) {
  expect_same<Taylor>(Coulomb{}, 1e-10);
}
RC_GTEST_PROP(ConstantSlidingTest, EventGaussOnDahl, ()) {
  expect_same<Gauss>(any_dahl(), 1e-8);
}
RC_GTEST_PROP(ConstantSlidingTest, StrangOnDahl, ()) {
  expect_same<Strang>(any_dahl(), 1e-3);
}
RC_GTEST_PROP(ConstantSlidingTest, Rk4OnDahl, ()) {
  expect_same<Rk4>(any_dahl(), 0.05);
}
RC_GTEST_PROP(ConstantSlidingTest, Rk4OnCoulomb, ()) {
  expect_same<Rk4>(Coulomb{}, 0.05);
}
RC_GTEST_PROP(ConstantSlidingTest, Rk4EventOnDahl, ()) {
  expect_same<Rk4Event>(any_dahl(), 0.05);
}

TEST(ConstantSlidingTest, CostsNoByte) {
  EXPECT_TRUE(std::is_empty_v<ConstantSliding>);
  EXPECT_EQ(sizeof(Taylor<Plant<Dahl, ConstantSliding>>),
            sizeof(Taylor<Plant<Dahl, LinearSliding>>));
}

}  // namespace
}  // namespace sonoglide::plant::sliding_test
