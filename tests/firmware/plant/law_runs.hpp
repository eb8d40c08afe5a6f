/// What the tests of the contact laws have in common: prescribed vibration, the tolerance, mirrored
/// motion and the energy.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "random.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant {

template <class Law>
using LawModel = Model<Law, Damped<typename Law::Scalar>, CosineDrive>;

template <std::size_t Order = 16, class Law>
EventTaylor<LawModel<Law>, Order> taylor(const Law& law, double tolerance, const Case& c = Case()) {
  return configured<EventTaylor<LawModel<Law>, Order>>(
      c.of(law), static_cast<typename Law::Scalar>(tolerance));
}

template <class Law>
Rk4<LawModel<Law>> fixed_steps(const Law& law, double step, const Case& c = Case()) {
  return configured<Rk4<LawModel<Law>>>(c.of(law), static_cast<typename Law::Scalar>(step));
}

/// Over carrier periods with drive amplitude 1, behind those in which the motion settles.
template <class Solver>
double mean_friction(Solver solver, StateFor<Solver> state, double velocity_ratio, int periods,
                     int settling_periods = 0) {
  using Scalar = typename Solver::Scalar;
  const auto sliding = static_cast<Scalar>(velocity_ratio);
  MeanFriction<Scalar> settling;
  MeanFriction<Scalar> account;
  EXPECT_EQ(run_periods(solver, settling_periods, Scalar(1), sliding, state, settling),
            Error::none);
  EXPECT_EQ(run_periods(solver, periods, Scalar(1), sliding, state, account), Error::none);
  return static_cast<double>(account.friction_integral) / (2.0 * pi * periods);
}

/// Under y = -cos tau: without reaction of friction and without a spring.
template <class Solver>
double prescribed_ratio(const Solver& solver, double velocity_ratio, int settling_periods = 0) {
  StateFor<Solver> state{};
  state.displacement = -1;
  return mean_friction(solver, state, velocity_ratio, 1, settling_periods);
}

/// mean: of a solver, its mean friction.
template <class Law, class Mean>
void expect_tolerance_is_that_of_the_mean(const Law& law, const Case& c, const Mean& mean,
                                          double expected) {
  EXPECT_NEAR(mean(taylor<8>(law, 1e-4, c)), expected, 1e-4);
  EXPECT_NEAR(mean(taylor<8>(law, 1e-6, c)), expected, 1e-6);
  EXPECT_NEAR(mean(taylor<12>(law, 1e-8, c)), expected, 1e-8);
  EXPECT_NEAR(mean(taylor<16>(law, 1e-10, c)), expected, 1e-10);
}

/// A contact whose friction acts back, from rest.
template <class Law>
void expect_tolerance_is_that_of_the_mean(const Law& law) {
  const Case c = Case().friction_force(0.3).stiffness(0.4);
  const auto mean = [](const auto& solver) { return mean_friction(solver, {}, 0.4, 4); };
  expect_tolerance_is_that_of_the_mean(law, c, mean, mean(taylor<16>(law, 1e-13, c)));
}

inline double mirrored(double x) {
  return -x;
}
template <std::size_t Count>
std::array<double, Count> mirrored(std::array<double, Count> numbers) {
  for (double& x : numbers) {
    x = -x;
  }
  return numbers;
}

/// Bit for bit: of a vibration along the sliding the whole motion; of another only the pull and its
/// friction, beside the same oscillator. The pull turns on the way.
template <class Law, class Memory>
void expect_mirror_image(const Law& law, const Memory& memory) {
  constexpr bool along = Law::vibration == friction::Vibration::along;
  auto solver = taylor(law, 1e-12, Case().friction_force(0.3).damping(0.05).stiffness(0.4));
  const auto moved = [&](double side) {
    const double own = along ? side : 1.0;
    typename LawModel<Law>::PlantState state{};
    state.displacement = 0.3 * own;
    state.velocity = -0.2 * own;
    contact_memory(state) = side > 0.0 ? memory : mirrored(memory);
    const Course course = lasting(30.0).from_phase(0.3).driven(own);
    return advanced(solver, course.sliding(0.4 * side).accelerating(-0.02 * side), state);
  };
  const auto one = moved(1.0);
  const auto other = moved(-1.0);
  const double own = along ? -1.0 : 1.0;
  EXPECT_EQ(one.displacement, own * other.displacement);
  EXPECT_EQ(one.velocity, own * other.velocity);
  EXPECT_EQ(one.friction, -other.friction);
  EXPECT_EQ(contact_memory(one), mirrored(contact_memory(other)));
}

// For properties.

inline Case random_case() {
  return Case()
      .friction_force(between(0.0, 0.8))
      .stiffness(between(0.0, 2.0))
      .damping(between(0.0, 0.3));
}

template <class Law>
typename LawModel<Law>::PlantState random_motion(const Law& /*law*/) {
  typename LawModel<Law>::PlantState state{};
  state.displacement = between(-1.0, 1.0);
  state.velocity = between(-1.0, 1.0);
  return state;
}

template <class Solver>
struct Moved {
  StateFor<Solver> state;
  EnergyAccount<double> account;
};

/// Two driven carrier periods, in which the energy balances.
template <class Solver>
Moved<Solver> balanced(Solver& solver, const typename Solver::Model& model,
                       const StateFor<Solver>& before, double sliding, double allowed = 1e-9) {
  Moved<Solver> moved{before, {}};
  RC_ASSERT(run_periods(solver, 2, between(0.0, 2.0), sliding, moved.state, moved.account) ==
            Error::none);
  RC_ASSERT(std::abs(moved.account.balance_residual(model, before, moved.state)) < allowed);
  return moved;
}

}  // namespace sonoglide::plant
