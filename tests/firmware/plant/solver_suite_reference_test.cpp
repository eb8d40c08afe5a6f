/// Every solver on the four scenes that are known to more than 20 digits.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "solver_suite.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::plant::solver_suite_reference_test {
namespace {

using tests::Table1;

struct ReferenceScene {
  std::string name;
  double contact_stiffness_N_per_m;
  double normal_force_N;
  double vibration_sign;
};

const ReferenceScene table1 = {"table1", Table1::contact_stiffness_N_per_m, Table1::normal_force_N,
                               1.0};
const ReferenceScene stiff_contact = {"stiff_contact", 1e9, Table1::normal_force_N, 1.0};
const ReferenceScene heavy_friction = {"heavy_friction", 1e9, 2000.0, 1.0};
const ReferenceScene table1_as_printed = {"table1_as_printed", Table1::contact_stiffness_N_per_m,
                                          Table1::normal_force_N, -1.0};

/// Mean friction over Fc, from rest over a hundred periods.
double known_ratio(const std::string& name) {
  return csv::read_file(REFERENCE_OPEN_LOOP).row_of("scene", name).number("rho_all");
}

struct Ratio {
  double relative_error = 0.0;
  Error error = Error::none;
};

/// setting: tolerance, or steps in a period.
template <class Method>
Ratio ratio(const ReferenceScene& scene, double setting) {
  using Scalar = typename Method::Scalar;
  using Model = DahlModel<Scalar>;
  const double force_amplitude_N = 384.0;
  const double length_m = force_amplitude_N / Table1::inertia_N_per_m;
  const double friction_limit_N = Table1::friction_coefficient * scene.normal_force_N;
  const double k = Table1::stiffness_N_per_m / Table1::inertia_N_per_m;
  const auto scalar = [](double x) { return static_cast<Scalar>(x); };
  const Model model =
      Case()
          .contact_stiffness(scene.contact_stiffness_N_per_m * length_m / friction_limit_N)
          .friction_force(friction_limit_N / force_amplitude_N)
          .vibration_sign(scene.vibration_sign)
          .stiffness(k);
  auto solver = configured<typename Method::template Solver<Model>>(
      model, scalar(setting > 1.0 ? 2.0 * pi / setting : setting));
  State<Scalar> state;
  MeanFriction<Scalar> account;
  const Error error = run_periods(solver, 100, Scalar(1), scalar(0.5 / (1.0 - k)), state, account);
  const double found = static_cast<double>(account.friction_integral) / (200.0 * pi);
  return {std::abs(found / known_ratio(scene.name) - 1.0), error};
}

template <class Method>
void expect_ratio(const ReferenceScene& scene, double setting, double relative_error) {
  const Ratio found = ratio<Method>(scene, setting);
  EXPECT_EQ(found.error, Error::none) << scene.name;
  EXPECT_LT(found.relative_error, relative_error) << scene.name << ' ' << setting;
}

TEST(SolverReference, Taylor) {
  for (const ReferenceScene& scene : {table1, stiff_contact, heavy_friction, table1_as_printed}) {
    expect_ratio<TaylorMethod<double, 8>>(scene, 1e-5, 1e-5);
    expect_ratio<TaylorMethod<double, 12>>(scene, 1e-9, 1e-9);
    expect_ratio<TaylorMethod<double, 16>>(scene, 1e-13, 1e-12);
    expect_ratio<TaylorMethod<float, 8>>(scene, 1e-7, 2e-5);
  }
}

TEST(SolverReference, Gauss) {
  for (const ReferenceScene& scene : {table1, stiff_contact, heavy_friction, table1_as_printed}) {
    expect_ratio<GaussMethod<float, 8>>(scene, 1e-7, 2e-5);
  }
}

TEST(SolverReference, Rk4) {
  for (const ReferenceScene& scene : {table1, table1_as_printed}) {
    expect_ratio<Rk4Method<double>>(scene, 1000.0, 1e-7);
    expect_ratio<Rk4Method<float>>(scene, 128.0, 1e-4);
  }
  expect_ratio<Rk4Method<double>>(heavy_friction, 1000.0, 1e-5);
  EXPECT_EQ(ratio<Rk4Method<double>>(stiff_contact, 1000.0).error, Error::friction_bound_broken);
}

TEST(SolverReference, Rk4Event) {
  for (const ReferenceScene& scene : {table1, table1_as_printed}) {
    expect_ratio<Rk4EventMethod<double>>(scene, 16.0, 2e-5);
    expect_ratio<Rk4EventMethod<double>>(scene, 128.0, 5e-9);
    expect_ratio<Rk4EventMethod<double>>(scene, 1000.0, 5e-12);
    expect_ratio<Rk4EventMethod<float>>(scene, 64.0, 2e-5);
  }
  expect_ratio<Rk4EventMethod<double>>(heavy_friction, 128.0, 5e-8);
  EXPECT_EQ(ratio<Rk4EventMethod<double>>(stiff_contact, 1000.0).error, Error::step_too_long);
}

TEST(SolverReference, EqualStepStrang) {
  for (const ReferenceScene& scene : {table1, table1_as_printed}) {
    expect_ratio<EqualStepStrangMethod<double>>(scene, 8.0, 1e-4);
    expect_ratio<EqualStepStrangMethod<double>>(scene, 32.0, 2e-7);
    expect_ratio<EqualStepStrangMethod<double>>(scene, 512.0, 1e-11);
    expect_ratio<EqualStepStrangMethod<float>>(scene, 16.0, 2e-5);
  }
  expect_ratio<EqualStepStrangMethod<double>>(stiff_contact, 16.0, 1e-4);
  expect_ratio<EqualStepStrangMethod<double>>(stiff_contact, 512.0, 1e-6);
  expect_ratio<EqualStepStrangMethod<double>>(heavy_friction, 32.0, 1e-3);
  expect_ratio<EqualStepStrangMethod<double>>(heavy_friction, 512.0, 2e-6);
}

TEST(SolverReference, Strang) {
  for (const ReferenceScene& scene : {table1, stiff_contact, heavy_friction, table1_as_printed}) {
    expect_ratio<StrangMethod>(scene, 1e-3, 1e-3);
    expect_ratio<StrangMethod>(scene, 1e-5, 1e-5);
  }
}

}  // namespace
}  // namespace sonoglide::plant::solver_suite_reference_test
