/// Oscillator without friction against closed forms, for both solvers.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::linear_motion_test {
namespace {

using Free = Model<friction::None<double>, Undamped<double>, NoDrive>;
using Driven = Model<friction::None<double>, Undamped<double>, CosineDrive>;
using DampedFree = Model<friction::None<double>, Damped<double>, NoDrive>;
using DampedDriven = Model<friction::None<double>, Damped<double>, CosineDrive>;

static_assert(sizeof(Free) == sizeof(double), "only the stiffness is a parameter");

/// Each solver with a setting at which it should be as exact as rounding lets it.
struct Taylor {
  template <class Model>
  using Solver = EventTaylor<Model, 16>;
  static constexpr const char* name = "Taylor";
  static constexpr double setting = 1e-15;
  static constexpr double tolerance = 1e-12;
};
struct RungeKutta {
  template <class Model>
  using Solver = Rk4<Model>;
  static constexpr const char* name = "RungeKutta";
  static constexpr double setting = 1e-3;
  static constexpr double tolerance = 1e-11;
};

template <class Method>
class LinearMotion : public testing::Test {
 protected:
  template <class Model>
  static State<double> after(const Model& model, double duration, double drive_amplitude,
                             const State<double>& from) {
    auto solver = configured<typename Method::template Solver<Model>>(model, Method::setting);
    return advanced(solver, lasting(duration).driven(drive_amplitude), from);
  }
};

using Methods = testing::Types<Taylor, RungeKutta>;
struct MethodName {
  template <class Method>
  static std::string GetName(int /*index*/) {
    return Method::name;
  }
};
TYPED_TEST_SUITE(LinearMotion, Methods, MethodName);

void expect_state(const State<double>& state, double displacement, double velocity,
                  double tolerance) {
  EXPECT_NEAR(state.displacement, displacement, tolerance);
  EXPECT_NEAR(state.velocity, velocity, tolerance);
  EXPECT_EQ(state.friction, 0.0);
}

constexpr double duration = 30.0;

TYPED_TEST(LinearMotion, FreeOscillation) {
  const double k = 0.37;
  const double w = std::sqrt(k);
  const State<double> end = this->after(Free{{}, {}, k}, duration, 0.0, {0.7, -0.4, 0.0});
  expect_state(end, 0.7 * std::cos(w * duration) - 0.4 / w * std::sin(w * duration),
               -0.7 * w * std::sin(w * duration) - 0.4 * std::cos(w * duration),
               TypeParam::tolerance);
}

TYPED_TEST(LinearMotion, FreeFlight) {
  const State<double> end = this->after(Free{{}, {}, 0.0}, duration, 0.0, {0.7, -0.4, 0.0});
  expect_state(end, 0.7 - 0.4 * duration, -0.4, TypeParam::tolerance);
}

TYPED_TEST(LinearMotion, UnstableSpring) {
  const State<double> end = this->after(Free{{}, {}, -0.04}, duration, 0.0, {1.0, 0.0, 0.0});
  const double growth = std::cosh(0.2 * duration);
  EXPECT_NEAR(end.displacement / growth, 1.0, TypeParam::tolerance);
}

TYPED_TEST(LinearMotion, DrivenFromRest) {
  const double k = 0.0467907;
  const double w = std::sqrt(k);
  const double gain = 1.3 / (k - 1.0);
  const State<double> end = this->after(Driven{{}, {}, k}, duration, 1.3, {});
  expect_state(end, gain * (std::cos(duration) - std::cos(w * duration)),
               gain * (-std::sin(duration) + w * std::sin(w * duration)), TypeParam::tolerance);
}

TYPED_TEST(LinearMotion, DrivenAtResonance) {
  const State<double> end = this->after(Driven{{}, {}, 1.0}, duration, 1.0, {});
  expect_state(end, 0.5 * duration * std::sin(duration),
               0.5 * (std::sin(duration) + duration * std::cos(duration)),
               10.0 * TypeParam::tolerance);
}

TYPED_TEST(LinearMotion, DrivenFreeMass) {
  const State<double> end = this->after(Driven{{}, {}, 0.0}, duration, 1.0, {});
  expect_state(end, 1.0 - std::cos(duration), std::sin(duration), 10.0 * TypeParam::tolerance);
}

TYPED_TEST(LinearMotion, NoDriveAmplitudeIsNoDrive) {
  const State<double> from = {0.3, 0.1, 0.0};
  const State<double> driven = this->after(Driven{{}, {}, 0.5}, duration, 0.0, from);
  const State<double> free = this->after(Free{{}, {}, 0.5}, duration, 0.0, from);
  EXPECT_EQ(driven.displacement, free.displacement);
  EXPECT_EQ(driven.velocity, free.velocity);
}

TYPED_TEST(LinearMotion, UnderdampedDecay) {
  const double d = 0.1;
  const double k = 1.7;
  const double w = std::sqrt(k - 0.25 * d * d);
  const double decay = std::exp(-0.5 * d * duration);
  const State<double> end = this->after(DampedFree{{}, {d}, k}, duration, 0.0, {1.0, 0.0, 0.0});
  expect_state(end, decay * (std::cos(w * duration) + 0.5 * d / w * std::sin(w * duration)),
               -decay * k / w * std::sin(w * duration), TypeParam::tolerance);
}

TYPED_TEST(LinearMotion, OverdampedDecay) {
  const double d = 12.0;
  const double k = 1.5;
  const double root = std::sqrt(d * d - 4.0 * k);
  const double slow = 2.0 * k / (-d - root);
  const double fast = 0.5 * (-d - root);
  const State<double> end = this->after(DampedFree{{}, {d}, k}, duration, 0.0, {1.0, 0.0, 0.0});
  expect_state(
      end, (fast * std::exp(slow * duration) - slow * std::exp(fast * duration)) / (fast - slow),
      slow * fast * (std::exp(slow * duration) - std::exp(fast * duration)) / (fast - slow),
      TypeParam::tolerance);
}

TYPED_TEST(LinearMotion, DampedSteadyOrbit) {
  const double d = 0.2;
  const std::complex<double> amplitude = 1.0 / std::complex<double>(1.1 - 1.0, d);
  const std::complex<double> rotation = std::polar(1.0, duration);
  const State<double> from = {amplitude.real(), -amplitude.imag(), 0.0};
  const State<double> end = this->after(DampedDriven{{}, {d}, 1.1}, duration, 1.0, from);
  expect_state(end, (amplitude * rotation).real(), -(amplitude * rotation).imag(),
               3.0 * TypeParam::tolerance);
}

TYPED_TEST(LinearMotion, AnEmptyIntervalChangesNothing) {
  const State<double> end = this->after(Driven{{}, {}, 0.5}, 0.0, 1.0, {0.3, -0.2, 0.0});
  EXPECT_EQ(end.displacement, 0.3);
  EXPECT_EQ(end.velocity, -0.2);
}

}  // namespace
}  // namespace sonoglide::plant::linear_motion_test
