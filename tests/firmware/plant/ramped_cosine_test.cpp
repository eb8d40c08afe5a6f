/// A drive whose amplitude passes along a straight line, against an integrator of others.

#include "firmware/plant/ramped_cosine.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "solver_suite.hpp"

namespace sonoglide::plant::ramped_cosine_test {
namespace {

template <class Scalar>
using RampedDahl = Model<friction::Dahl<Scalar>, Damped<Scalar>, RampedCosineDrive>;

template <class Scalar>
using RampedInterval = Interval<Scalar, LinearAmplitude<Scalar>>;

constexpr double turn = 2.0 * pi;

/// From one amplitude to another over a carrier period.
template <class Scalar = double>
RampedInterval<Scalar> period(double from, double to, double bias, double sliding,
                              double acceleration = 0.0) {
  return {Scalar(0),
          static_cast<Scalar>(turn),
          {static_cast<Scalar>(from), static_cast<Scalar>((to - from) / turn),
           static_cast<Scalar>(bias)},
          static_cast<Scalar>(sliding),
          static_cast<Scalar>(acceleration)};
}

/// y, v, φ; ∫φ, ∫f v, ∫v², ∫y²
using Reference = std::array<double, 7>;

struct Numbers {
  double kappa = 0.4;
  double beta = 0.05;
  double damping = 0.02;
  double stiffness = 0.3;
};

constexpr Case dahl(const Numbers& n) {
  return Case().contact_stiffness(n.kappa).friction_force(n.beta).damping(n.damping).stiffness(
      n.stiffness);
}

/// Runge-Kutta-Fehlberg of order 8 from one reversal of the sliding to the next, which bisection finds.
class Integrator {
 public:
  Integrator(const Numbers& numbers, const RampedInterval<double>& interval)
      : n_(numbers), interval_(interval) {}

  Reference operator()(const State<double>& start) {
    Reference x = {start.displacement, start.velocity, start.friction, 0.0, 0.0, 0.0, 0.0};
    constexpr int steps = 400;
    const double step = interval_.duration / steps;
    for (int i = 0; i < steps; ++i) {
      const double end = (i + 1) * step;
      double t = i * step;
      // A reversal, a second one in the same step, and the rest.
      for (int part = 0; part < 3 && t < end; ++part) {
        direction_ = sliding(x, t) < 0.0 ? -1.0 : 1.0;
        if (std::abs(sliding(x, t)) < 1e-13) {
          direction_ = sliding(after(x, t, 1e-6), t + 1e-6) < 0.0 ? -1.0 : 1.0;
        }
        const double taken = up_to_reversal(x, t, end - t);
        x = after(x, t, taken);
        t += taken;
      }
    }
    return x;
  }

 private:
  double sliding(const Reference& x, double t) const {
    return interval_.sliding_velocity + interval_.sliding_acceleration * t + x[1];
  }

  double up_to_reversal(const Reference& x, double t, double length) const {
    const auto goes_on = [&](double part) {
      return direction_ * sliding(after(x, t, part), t + part) >= 0.0;
    };
    if (goes_on(length)) {
      return length;
    }
    double before = 0.0;
    double beyond = length;
    while (beyond - before > 1e-15) {
      const double middle = 0.5 * (before + beyond);
      (goes_on(middle) ? before : beyond) = middle;
    }
    return beyond;
  }

  Reference after(Reference x, double t, double length) const {
    const auto slope = [this](const Reference& at, Reference& rate, double time) {
      const auto& [y, v, phi, mean, work, speed, square] = at;
      const double theta = interval_.phase_begin + time;
      const LinearAmplitude<double>& a = interval_.drive_amplitude;
      const double force = (a.at_zero + a.slope * theta) * std::cos(theta) + a.bias;
      rate = {v,
              force - n_.damping * v - n_.stiffness * y - n_.beta * phi,
              n_.kappa * sliding(at, time) * (1.0 - direction_ * phi),
              phi,
              force * v,
              v * v,
              y * y};
    };
    boost::numeric::odeint::runge_kutta_fehlberg78<Reference> stepper;
    stepper.do_step(slope, x, t, length);
    return x;
  }

  Numbers n_;
  RampedInterval<double> interval_;
  double direction_ = 1.0;
};

template <class Method>
class RampedCosineTest : public testing::Test {};
TYPED_TEST_SUITE(RampedCosineTest, SolverMethods, SolverMethodName);

/// Three periods in a row, the last of them under a sliding that speeds up.
TYPED_TEST(RampedCosineTest, AgreesWithAnotherIntegrator) {
  using Scalar = typename TypeParam::Scalar;
  using Solver = typename TypeParam::template Solver<RampedDahl<Scalar>>;
  const double tolerance =
      std::is_same_v<TypeParam, Rk4Method<Scalar>> ? TypeParam::across : TypeParam::smooth;
  for (const double damping : {0.0, 0.02}) {
    const Numbers numbers{0.4, 0.05, damping, 0.3};
    const RampedDahl<Scalar> model = dahl(numbers);
    auto solver = configured<Solver>(model, static_cast<Scalar>(TypeParam::setting));
    State<Scalar> state;
    Reference reference{};
    for (const auto& [from, to, bias, acceleration] :
         {std::array{0.0, 1.3, 0.0, 0.0}, std::array{1.3, 0.4, 0.07, 0.0},
          std::array{0.4, 1.0, -0.03, 0.02}}) {
      reference = Integrator(numbers, period(from, to, bias, 0.4, acceleration))(
          {reference[0], reference[1], reference[2]});
      const State<Scalar> before = state;
      EnergyAccount<Scalar> account;
      NoObserver nobody;
      EXPECT_EQ(
          solver.advance(period<Scalar>(from, to, bias, 0.4, acceleration), state, account, nobody)
              .error,
          Error::none);
      const double loose = 20.0 * tolerance;
      EXPECT_NEAR(static_cast<double>(state.displacement), reference[0], loose);
      EXPECT_NEAR(static_cast<double>(state.velocity), reference[1], loose);
      EXPECT_NEAR(static_cast<double>(state.friction), reference[2], loose);
      EXPECT_NEAR(static_cast<double>(account.friction_integral), reference[3], loose);
      EXPECT_NEAR(static_cast<double>(account.drive_work), reference[4], loose);
      EXPECT_NEAR(static_cast<double>(account.velocity_square), reference[5], loose);
      EXPECT_NEAR(static_cast<double>(account.displacement_square), reference[6], loose);
      EXPECT_NEAR(static_cast<double>(account.balance_residual(model, before, state)), 0.0, loose);
    }
  }
}

/// The contact of Table 1 in the paper: a panel takes the period whole.
template <std::size_t Nodes>
void expect_panels(double tolerance) {
  const Numbers numbers{0.385592, 5.109e-5, 0.01, 0.0467907};
  const RampedDahl<double> model = dahl(numbers);
  auto solver = configured<EventGauss<RampedDahl<double>, Nodes>>(model, tolerance);
  State<double> state;
  Reference reference{};
  std::uint64_t periods = 0;
  for (const auto& [from, to, bias, acceleration] :
       {std::array{0.6, 1.0, 0.0, 0.0}, std::array{1.0, 0.7, 0.02, 0.0},
        std::array{0.7, 0.9, -0.03, 0.02}}) {
    const auto interval = period(from, to, bias, 0.5, acceleration);
    reference = Integrator(numbers, interval)({reference[0], reference[1], reference[2]});
    const State<double> before = state;
    EnergyAccount<double> account;
    NoObserver nobody;
    EXPECT_EQ(solver.advance(interval, state, account, nobody).error, Error::none);
    EXPECT_EQ(solver.cost().steps, ++periods);
    EXPECT_NEAR(state.displacement, reference[0], tolerance);
    EXPECT_NEAR(state.velocity, reference[1], tolerance);
    EXPECT_NEAR(account.friction_integral, reference[3], 10.0 * tolerance);
    EXPECT_NEAR(account.drive_work, reference[4], 10.0 * tolerance);
    EXPECT_NEAR(account.velocity_square, reference[5], 10.0 * tolerance);
    EXPECT_NEAR(account.displacement_square, reference[6], 10.0 * tolerance);
    EXPECT_NEAR(account.balance_residual(model, before, state), 0.0, 10.0 * tolerance);
  }
}

TEST(RampedGauss, TakesAPeriodInOneStep) {
  expect_panels<8>(1e-8);
  expect_panels<12>(1e-9);
}

}  // namespace
}  // namespace sonoglide::plant::ramped_cosine_test
