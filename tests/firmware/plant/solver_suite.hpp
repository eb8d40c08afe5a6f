/// The solvers under one suite: each with a setting that leaves little but rounding, and with what
/// that setting is held to.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <type_traits>

#include "firmware/plant/gauss/event_gauss.hpp"
#include "firmware/plant/rk4/rk4_event.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "firmware/plant/strang/strang.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant {

template <class Scalar>
inline constexpr bool is_single = std::is_same_v<Scalar, float>;

/// setting: step in radians of the carrier, or tolerance, as the constructor takes it;
/// coarse_setting: that of the test of the friction bound. smooth: error of motion and friction
/// without reversals; across: with them.
template <class Number, std::size_t Order>
struct TaylorMethod {
  using Scalar = Number;
  template <class Model>
  using Solver = EventTaylor<Model, Order>;
  static std::string name() { return "Taylor" + std::to_string(Order); }
  static constexpr double setting = is_single<Number> ? 1e-7 : 1e-15;
  static constexpr double coarse_setting = 1e-3;
  static constexpr double smooth = is_single<Number> ? 3e-5 : 1e-13;
  static constexpr double across = smooth;
};

template <class Number>
struct Rk4Method {
  using Scalar = Number;
  template <class Model>
  using Solver = Rk4<Model>;
  static std::string name() { return "Rk4"; }
  static constexpr double setting = is_single<Number> ? 0.02 : 1e-3;
  static constexpr double coarse_setting = 0.3;
  static constexpr double smooth = is_single<Number> ? 1e-4 : 1e-11;
  static constexpr double across = is_single<Number> ? 5e-4 : 2e-6;
};

template <class Number>
struct Rk4EventMethod {
  using Scalar = Number;
  template <class Model>
  using Solver = Rk4Event<Model>;
  static std::string name() { return "Rk4Event"; }
  static constexpr double setting = is_single<Number> ? 0.05 : 1e-3;
  static constexpr double coarse_setting = 0.3;
  static constexpr double smooth = is_single<Number> ? 1e-4 : 1e-11;
  static constexpr double across = smooth;
};

template <class Number>
struct EqualStepStrangMethod {
  using Scalar = Number;
  template <class Model>
  using Solver = EqualStepStrang<Model>;
  static std::string name() { return "EqualStepStrang"; }
  static constexpr double setting = is_single<Number> ? 0.01 : 1e-3;
  static constexpr double coarse_setting = 0.3;
  static constexpr double smooth = is_single<Number> ? 1e-4 : 2e-7;
  static constexpr double across = smooth;
};

/// The splitting that a scene gets under the name of strang.
struct StrangMethod {
  using Scalar = double;
  template <class Model>
  using Solver = Strang<Model>;
  static std::string name() { return "Strang"; }
  static constexpr double setting = 1e-6;
  static constexpr double coarse_setting = 1e-2;
  static constexpr double smooth = 1e-5;
  static constexpr double across = smooth;
};

/// Only with friction: without it there is nothing that it solves.
template <class Number, std::size_t Nodes>
struct GaussMethod {
  using Scalar = Number;
  template <class Model>
  using Solver = EventGauss<Model, Nodes>;
  static std::string name() { return "Gauss" + std::to_string(Nodes); }
  static constexpr double setting = is_single<Number> ? 1e-7 : 1e-12;
  static constexpr double coarse_setting = 1e-3;
  static constexpr double smooth = is_single<Number> ? 3e-5 : 1e-10;
  static constexpr double across = smooth;
};

using OscillatorMethods =
    testing::Types<TaylorMethod<double, 8>, TaylorMethod<double, 12>, TaylorMethod<double, 16>,
                   Rk4Method<double>, Rk4EventMethod<double>, EqualStepStrangMethod<double>,
                   StrangMethod, TaylorMethod<float, 8>, Rk4Method<float>, Rk4EventMethod<float>,
                   EqualStepStrangMethod<float>>;
using SolverMethods =
    testing::Types<TaylorMethod<double, 8>, TaylorMethod<double, 12>, TaylorMethod<double, 16>,
                   Rk4Method<double>, Rk4EventMethod<double>, EqualStepStrangMethod<double>,
                   StrangMethod, GaussMethod<double, 8>, GaussMethod<float, 8>,
                   TaylorMethod<float, 8>, Rk4Method<float>, Rk4EventMethod<float>,
                   EqualStepStrangMethod<float>>;

struct SolverMethodName {
  template <class Method>
  static std::string GetName(int /*index*/) {
    return Method::name() + (is_single<typename Method::Scalar> ? "Single" : "Double");
  }
};

template <class To, class From>
State<To> state_cast(const State<From>& state) {
  return {static_cast<To>(state.displacement), static_cast<To>(state.velocity),
          static_cast<To>(state.friction)};
}

template <class Scalar>
using DampedFrictionless = Model<friction::None<Scalar>, Damped<Scalar>, CosineDrive>;

struct Advanced {
  State<double> state;
  EnergyAccount<double> account;
  double balance_residual = 0.0;
  Error error = Error::none;
  Cost cost;
};

/// One advance of one method.
template <class Method, template <class> class ModelOf = DampedDahlModel>
Advanced run_of(const Case& c, const Course& course, const State<double>& start,
                double setting = Method::setting) {
  using Scalar = typename Method::Scalar;
  using Model = ModelOf<Scalar>;
  const Model model = c;
  auto solver =
      configured<typename Method::template Solver<Model>>(model, static_cast<Scalar>(setting));
  const State<Scalar> before = state_cast<Scalar>(start);
  State<Scalar> state = before;
  EnergyAccount<Scalar> account;
  const Error error = advance(solver, course, state, account).error;
  const auto wide = [](Scalar x) { return static_cast<double>(x); };
  return {state_cast<double>(state),
          {wide(account.friction_integral), wide(account.friction_work), wide(account.sliding_work),
           wide(account.drive_work), wide(account.damping_work)},
          wide(account.balance_residual(model, before, state)),
          error,
          solver.cost()};
}

inline void expect_near(const State<double>& actual, const State<double>& expected,
                        double tolerance) {
  EXPECT_NEAR(actual.displacement, expected.displacement, tolerance);
  EXPECT_NEAR(actual.velocity, expected.velocity, tolerance);
  EXPECT_NEAR(actual.friction, expected.friction, tolerance);
}

}  // namespace sonoglide::plant
