/// Iwan contact against closed forms, quadrature, its limits and another solver.

#include "firmware/friction/iwan.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>

#include "firmware/plant/rk4/rk4_event.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "law_runs.hpp"

namespace sonoglide::plant::iwan_test {
namespace {

using Law = friction::Iwan<double>;
using PlantModel = LawModel<Law>;
using Taylor = EventTaylor<PlantModel, 16>;
using Forces = Law::Memory;

static_assert(Taylor::solves<Law>);
static_assert(!Rk4<DahlModel<double>>::solves<Law>);
static_assert(!Rk4Event<DahlModel<double>>::solves<Law>);
static_assert(!EqualStepStrang<DahlModel<double>>::solves<Law>);

/// Forces of all elements after a displacement that does not turn.
Forces loaded(const Law& law, const Forces& forces, double displacement) {
  return Law::Arc(law, displacement < 0.0 ? -1.0 : 1.0, forces)
      .memory_after(std::abs(displacement));
}
double friction_of(const Law& law, const Forces& forces) {
  return law.friction(0.0, forces);
}

TEST(Iwan, FirstLoadMeetsTheParabolaAtItsCorners) {
  for (const std::size_t n : {1U, 2U, 5U, 8U}) {
    const Law law = {3.0, n};
    for (std::size_t j = 0; j <= n; ++j) {
      const double u = 2.0 * static_cast<double>(j) / static_cast<double>(n) / 3.0;
      EXPECT_NEAR(friction_of(law, loaded(law, {}, u)), 3.0 * u - 2.25 * u * u, 1e-15) << n;
    }
    EXPECT_NEAR(friction_of(law, loaded(law, {}, 10.0)), 1.0, 1e-15);
  }
}

/// Masing's rule: unloading is the first load, twice as large.
TEST(Iwan, UnloadsByMasingsRule) {
  const Law law = {2.0, 7};
  const Forces begin = loaded(law, {}, 0.6);
  for (const double u : {0.1, 0.5, 0.9, 1.2}) {
    EXPECT_NEAR(friction_of(law, loaded(law, begin, -u)),
                friction_of(law, begin) - 2.0 * friction_of(law, loaded(law, {}, 0.5 * u)), 1e-15);
  }
}

TEST(Iwan, WorkIsTheIntegralOfTheForce) {
  const Law law = {2.0, 5};
  const Forces begin = loaded(law, {}, 0.5);
  for (const double direction : {1.0, -1.0}) {
    const Law::Arc arc(law, direction, begin);
    constexpr int points = 100000;
    double sum = 0.0;
    for (int i = 0; i < points; ++i) {
      sum += direction * arc.friction_after(1.7 * (i + 0.5) / points);
    }
    EXPECT_NEAR(arc.work(1.7), 1.7 * sum / points, 1e-9);
  }
}

double periodic_ratio(const Law& law, double velocity_ratio, int settling_periods) {
  return prescribed_ratio(taylor(law, 1e-13), velocity_ratio, settling_periods);
}

/// The same, element by element, by quadrature over the place r theta + sin theta, r < 1: an
/// element unloads from its limit behind the turn at V = 0, and loads up to it again behind the
/// next one.
double quadrature_ratio(const Law& law, double r) {
  const auto place = [r](double theta) { return r * theta + std::sin(theta); };
  const double turn = std::acos(-r);
  const double back = 2.0 * pi - turn;
  const double travel_back = place(turn) - place(back);
  constexpr int points = 100000;
  double sum = 0.0;
  for (std::size_t i = 0; i < law.elements; ++i) {
    const double limit = law.slip_limit(i);
    const double stiffness = law.element_stiffness();
    const double lowest = std::max(-limit, limit - stiffness * travel_back);
    for (int j = 0; j < points; ++j) {
      const double backwards = turn + (back - turn) * (j + 0.5) / points;
      const double forwards = back + 2.0 * turn * (j + 0.5) / points;
      sum += (back - turn) / points *
             std::max(-limit, limit - stiffness * (place(turn) - place(backwards)));
      sum += 2.0 * turn / points *
             std::min(limit, lowest + stiffness * (place(forwards) - place(back)));
    }
  }
  return sum / (2.0 * pi);
}

TEST(Iwan, MeanUnderPrescribedVibrationIsThatOfQuadrature) {
  for (const std::size_t n : {1U, 3U, 8U}) {
    for (const double stiffness : {0.2, 0.7, 3.0, 40.0}) {
      for (const double r : {0.02, 0.3, 0.8}) {
        const Law law = {stiffness, n};
        EXPECT_NEAR(periodic_ratio(law, r, 80), quadrature_ratio(law, r), 1e-8)
            << n << ' ' << stiffness << ' ' << r;
      }
    }
  }
}

/// What is stuck elastically keeps its friction: (1 - kappa)_+ for one element.
TEST(Iwan, VibrationAboutASlowSlideLeavesTheElasticFloor) {
  for (const double stiffness : {0.1, 0.4, 0.9, 1.5}) {
    EXPECT_NEAR(periodic_ratio({stiffness, 1}, 1e-3, 3000), std::max(0.0, 1.0 - stiffness), 5e-3);
    double floor = 0.0;
    const Law law = {stiffness, 4};
    for (std::size_t i = 0; i < 4; ++i) {
      floor += std::max(0.0, law.slip_limit(i) - 0.25 * stiffness);
    }
    EXPECT_NEAR(quadrature_ratio(law, 1e-5), floor, 1e-3);
  }
}

TEST(IwanLimits, Coulomb) {
  EXPECT_NEAR(periodic_ratio({3e4, 1}, 0.5, 2), 1.0 / 3.0, 1e-4);
  EXPECT_NEAR(periodic_ratio({3e4, 8}, 0.8, 2), 2.0 / pi * std::asin(0.8), 1e-4);
}

TEST(IwanLimits, SinglePrecision) {
  EXPECT_NEAR(prescribed_ratio(taylor<8>(friction::Iwan<float>{0.7F, 3}, 1e-6), 0.3, 30),
              quadrature_ratio({0.7, 3}, 0.3), 2e-5);
}

/// Elements that do not slip are a spring: y'' = -(k + beta kappa) y.
TEST(Iwan, StuckContactIsASpring) {
  const double frequency = std::sqrt(0.3 + 0.5 * 40.0);
  auto solver = taylor(Law{40.0, 8}, 1e-14, Case().friction_force(0.5).stiffness(0.3));
  RememberingState<Law> state = {{1e-4, 0.0, 0.0}, {}};
  state.memory.fill(40.0 / 8.0 * 1e-4);
  state = advanced(solver, lasting(9.7), state);
  EXPECT_NEAR(state.displacement / 1e-4, std::cos(9.7 * frequency), 1e-9);
  EXPECT_NEAR(state.friction / 1e-4, 40.0 * std::cos(9.7 * frequency), 1e-7);
}

/// The same plant by short steps of an integrator of the Boost library, whose sliders are moved
/// back to their limits behind each step.
struct Peer {
  using Numbers = std::array<double, 5>;  // y, v, phi_1, phi_2, phi_3

  static Numbers state(const PlantModel& model, const Interval<double>& interval, Numbers x) {
    const Law& law = model.law;
    boost::numeric::odeint::runge_kutta4<Numbers> stepper;
    constexpr int steps = 400000;
    const double step = interval.duration / steps;
    const auto slope = [&](const Numbers& at, Numbers& rate, double time) {
      const double velocity = interval.sliding_velocity + interval.sliding_acceleration * time +
                              model.vibration_sign * at[1];
      double friction = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double limit = law.slip_limit(i);
        rate[2 + i] = law.element_stiffness() * velocity;
        friction += std::clamp(at[2 + i], -limit, limit);
      }
      rate[0] = at[1];
      rate[1] = interval.drive_amplitude * std::cos(interval.phase_begin + time) -
                model.stiffness * at[0] - model.friction_force * friction;
    };
    for (int j = 0; j < steps; ++j) {
      stepper.do_step(slope, x, j * step, step);
      for (std::size_t i = 0; i < 3; ++i) {
        x[2 + i] = std::clamp(x[2 + i], -law.slip_limit(i), law.slip_limit(i));
      }
    }
    return x;
  }
};

TEST(Iwan, ReversingContactAgreesWithAPeer) {
  for (const double sign : {1.0, -1.0}) {
    const PlantModel model =
        Case().friction_force(0.3).vibration_sign(sign).stiffness(0.4).of(Law{2.5, 3});
    const Interval<double> interval =
        lasting(9.0).from_phase(0.8).driven(1.0).sliding(0.4).accelerating(0.01);
    const Peer::Numbers expected = Peer::state(model, interval, {0.3, -0.2, 0.1, -0.2, 0.3});
    auto solver = configured<Taylor>(model, 1e-13);
    const auto state = advanced(solver, interval, {{0.3, -0.2, 0.0}, {0.1, -0.2, 0.3}});
    EXPECT_NEAR(state.displacement, expected[0], 1e-8);
    EXPECT_NEAR(state.velocity, expected[1], 1e-8);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(state.memory[i], expected[2 + i], 1e-8) << i;
    }
    EXPECT_GE(solver.cost().events, 2U);
    EXPECT_LE(solver.cost().events, 20U);
  }
}

TEST(Iwan, ToleranceIsThatOfTheMeanFriction) {
  expect_tolerance_is_that_of_the_mean(Law{2.5, 5});
}

TEST(Iwan, MirroredMotionIsTheMirrorImageBitForBit) {
  expect_mirror_image(Law{2.5, 3}, Forces{0.1});
}

RC_GTEST_PROP(IwanProperties, KeepsItsBoundsBalancesItsEnergyAndIsPassive, ()) {
  const Law law = {std::pow(10.0, between(-2.0, 3.0)), *rc::gen::inRange<std::size_t>(1, 9)};
  const PlantModel model = random_case().of(law);
  RememberingState<Law> before = random_motion(law);
  double stored = 0.0;
  for (std::size_t i = 0; i < law.elements; ++i) {
    before.memory[i] = law.slip_limit(i) * between(-1.0, 1.0);
    stored -= before.memory[i] * before.memory[i] / (2.0 * law.element_stiffness());
  }
  auto solver = configured<Taylor>(model, 1e-12);
  const auto [state, account] = balanced(solver, model, before, between(-2.0, 2.0));
  RC_ASSERT(std::abs(state.friction) <= 1.0 + 1e-15);
  for (std::size_t i = 0; i < law.elements; ++i) {
    RC_ASSERT(std::abs(state.memory[i]) <= law.slip_limit(i));
    stored += state.memory[i] * state.memory[i] / (2.0 * law.element_stiffness());
  }
  RC_ASSERT(account.friction_work >= stored - 1e-9);
}

}  // namespace
}  // namespace sonoglide::plant::iwan_test
