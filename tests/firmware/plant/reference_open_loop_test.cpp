/// Agreement with time-accurate values of four scenes, known to more than 20 digits.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "firmware/plant/gauss/event_gauss.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/csv/csv.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::reference_open_loop_test {
namespace {

using tests::Table1;

struct Scene {
  std::string name;
  double contact_stiffness_N_per_m;
  double normal_force_N;
  double vibration_sign;
};

const Scene table1 = {"table1", Table1::contact_stiffness_N_per_m, Table1::normal_force_N, 1.0};
const Scene stiff_contact = {"stiff_contact", 1e9, Table1::normal_force_N, 1.0};
const Scene heavy_friction = {"heavy_friction", 1e9, 2000.0, 1.0};
const Scene table1_as_printed = {"table1_as_printed", Table1::contact_stiffness_N_per_m,
                                 Table1::normal_force_N, -1.0};

struct Values {
  double displacement_m;
  double velocity_m_per_s;
  double friction_N;
  double friction_ratio;
  double friction_ratio_second_half;
  double dissipation_ratio;
  double dissipation_ratio_second_half;
};

Values reference(const std::string& name) {
  const csv::Table table = csv::read_file(REFERENCE_OPEN_LOOP);
  const csv::Row& row = table.row_of("scene", name);
  return {row.number("x_end_m"),    row.number("v_end_m_per_s"), row.number("F_end_N"),
          row.number("rho_all"),    row.number("rho_last"),      row.number("phi_fu_all"),
          row.number("phi_fu_last")};
}

constexpr double stiffness_N_per_m = Table1::stiffness_N_per_m;
constexpr double angular_frequency = Table1::carrier_rad_per_s;
constexpr double force_amplitude_N = 384.0;
constexpr double inertia_N_per_m = Table1::inertia_N_per_m;
constexpr double length_m = force_amplitude_N / inertia_N_per_m;
constexpr double paper_step = 1.667e-8 * angular_frequency;

/// A hundred carrier periods from rest; sets the error by which the solver stopped, if any.
template <template <class> class SolverOf, class Scalar>
Values run(const Scene& scene, double setting, Error& error) {
  const double friction_limit_N = Table1::friction_coefficient * scene.normal_force_N;
  const double velocity_ratio_half =
      0.5 * inertia_N_per_m / std::abs(stiffness_N_per_m - inertia_N_per_m);
  const auto scalar = [](double x) { return static_cast<Scalar>(x); };
  const DahlModel<Scalar> model =
      Case()
          .contact_stiffness(scene.contact_stiffness_N_per_m * length_m / friction_limit_N)
          .friction_force(friction_limit_N / force_amplitude_N)
          .vibration_sign(scene.vibration_sign)
          .stiffness(stiffness_N_per_m / inertia_N_per_m);
  auto solver = configured<SolverOf<DahlModel<Scalar>>>(model, scalar(setting));
  State<Scalar> state;
  EnergyAccount<Scalar> first;
  EnergyAccount<Scalar> second;
  error = run_periods(solver, 50, Scalar(1), scalar(velocity_ratio_half), state, first);
  if (error == Error::none) {
    error = run_periods(solver, 50, Scalar(1), scalar(velocity_ratio_half), state, second);
  }
  const double half_run = 100.0 * pi;
  const double friction =
      static_cast<double>(first.friction_integral) + static_cast<double>(second.friction_integral);
  const double work =
      static_cast<double>(first.friction_work) + static_cast<double>(second.friction_work);
  return {static_cast<double>(state.displacement) * length_m,
          static_cast<double>(state.velocity) * length_m * angular_frequency,
          static_cast<double>(state.friction) * friction_limit_N,
          friction / (2.0 * half_run),
          static_cast<double>(second.friction_integral) / half_run,
          work / (2.0 * half_run * velocity_ratio_half),
          static_cast<double>(second.friction_work) / (half_run * velocity_ratio_half)};
}

template <class Model>
using Taylor16 = EventTaylor<Model, 16>;
template <class Model>
using Taylor12 = EventTaylor<Model, 12>;
template <class Model>
using Taylor8 = EventTaylor<Model, 8>;

template <class Model>
using Gauss8 = EventGauss<Model, 8>;
template <class Model>
using Gauss12 = EventGauss<Model, 12>;

void expect_near(const Values& actual, const Values& expected, double relative) {
  const auto close = [relative](double a, double b) { EXPECT_NEAR(a, b, relative * std::abs(b)); };
  close(actual.displacement_m, expected.displacement_m);
  close(actual.velocity_m_per_s, expected.velocity_m_per_s);
  close(actual.friction_N, expected.friction_N);
  close(actual.friction_ratio, expected.friction_ratio);
  close(actual.friction_ratio_second_half, expected.friction_ratio_second_half);
  close(actual.dissipation_ratio, expected.dissipation_ratio);
  close(actual.dissipation_ratio_second_half, expected.dissipation_ratio_second_half);
}

class ReferenceOpenLoop : public testing::TestWithParam<Scene> {};

TEST_P(ReferenceOpenLoop, TightTaylor) {
  Error error = Error::none;
  const Values values = run<Taylor16, double>(GetParam(), 1e-12, error);
  EXPECT_EQ(error, Error::none);
  expect_near(values, reference(GetParam().name), 1e-11);
}

TEST_P(ReferenceOpenLoop, TheToleranceIsThatOfTheFrictionRatio) {
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    Error error = Error::none;
    const Values values = run<Taylor12, double>(GetParam(), tolerance, error);
    EXPECT_EQ(error, Error::none);
    EXPECT_NEAR(values.friction_ratio, reference(GetParam().name).friction_ratio, tolerance);
  }
}

/// Two of the scenes are weakly coupled: there a period is a panel.
TEST_P(ReferenceOpenLoop, TheToleranceOfGaussIsThatOfTheFrictionRatio) {
  const double expected = reference(GetParam().name).friction_ratio;
  Error error = Error::none;
  for (const double tolerance : {1e-6, 1e-8}) {
    EXPECT_NEAR((run<Gauss8, double>(GetParam(), tolerance, error).friction_ratio), expected,
                tolerance);
    EXPECT_EQ(error, Error::none);
  }
  EXPECT_NEAR((run<Gauss12, double>(GetParam(), 1e-10, error).friction_ratio), expected, 1e-10);
  EXPECT_EQ(error, Error::none);
}

TEST_P(ReferenceOpenLoop, TaylorAtAnOrdinaryTolerance) {
  Error error = Error::none;
  const Values values = run<Taylor12, double>(GetParam(), 1e-9, error);
  EXPECT_EQ(error, Error::none);
  expect_near(values, reference(GetParam().name), 2e-8);
  EXPECT_NEAR(values.friction_ratio, reference(GetParam().name).friction_ratio, 1e-9);
}

TEST_P(ReferenceOpenLoop, SinglePrecision) {
  Error error = Error::none;
  const Values values = run<Taylor8, float>(GetParam(), 1e-7, error);
  EXPECT_EQ(error, Error::none);
  const Values expected = reference(GetParam().name);
  EXPECT_NEAR(values.friction_ratio / expected.friction_ratio, 1.0, 1e-5);
  EXPECT_NEAR(values.dissipation_ratio / expected.dissipation_ratio, 1.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ReferenceOpenLoop,
                         testing::Values(table1, stiff_contact, heavy_friction, table1_as_printed),
                         [](const auto& scene) { return scene.param.name; });

TEST(ReferenceOpenLoopRk4, ThePapersStepHasSevenDigitsWhereTheContactIsSoft) {
  for (const Scene& scene : {table1, table1_as_printed}) {
    Error error = Error::none;
    const Values values = run<Rk4, double>(scene, paper_step, error);
    EXPECT_EQ(error, Error::none);
    const Values expected = reference(scene.name);
    EXPECT_NEAR(values.friction_ratio / expected.friction_ratio, 1.0, 1e-7);
    EXPECT_NEAR(values.dissipation_ratio / expected.dissipation_ratio, 1.0, 1e-7);
    EXPECT_NEAR(values.displacement_m / expected.displacement_m, 1.0, 1e-8);
  }
}

TEST(ReferenceOpenLoopRk4, ThePapersStepLosesDigitsUnderHeavyFriction) {
  Error error = Error::none;
  const Values values = run<Rk4, double>(heavy_friction, paper_step, error);
  EXPECT_EQ(error, Error::none);
  const double deviation =
      std::abs(values.friction_ratio / reference(heavy_friction.name).friction_ratio - 1.0);
  EXPECT_LT(deviation, 1e-5);
  EXPECT_GT(deviation, 1e-7);
}

TEST(ReferenceOpenLoopRk4, ThePapersStepBreaksTheFrictionBoundInStiffContact) {
  Error error = Error::none;
  run<Rk4, double>(stiff_contact, paper_step, error);
  EXPECT_EQ(error, Error::friction_bound_broken);
}

TEST(ReferenceOpenLoopRk4, ThePapersStepIsAThousandthOfThePeriod) {
  const DahlModel<double> model = Case().contact_stiffness(1.0).friction_force(1.0).stiffness(1.0);
  auto solver = configured<Rk4<DahlModel<double>>>(model, paper_step);
  advanced(solver, lasting(2.0 * pi).driven(1.0).sliding(0.5), {});
  EXPECT_EQ(solver.cost().steps, 1000U);
}

}  // namespace
}  // namespace sonoglide::plant::reference_open_loop_test
