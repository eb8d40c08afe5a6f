/// Every solver on the four scenes that are known to more than 20 digits.

#include <gtest/gtest.h>

#include <cmath>

#include "solver_suite.hpp"
#include "tests/common/reference/open_loop.hpp"

namespace sonoglide::plant::reference_open_loop_test {
namespace {

using tests::Table1;
using tests::open_loop::Scene;
using tests::open_loop::Values;
namespace open_loop = tests::open_loop;

struct Run {
  Values values;
  Error error = Error::none;
};

/// setting: tolerance, or steps in a period.
template <class Method>
Run run(const Scene& scene, double setting) {
  using Scalar = typename Method::Scalar;
  using Model = DahlModel<Scalar>;
  const double force_amplitude_N = 384.0;
  const double length_m = force_amplitude_N / Table1::inertia_N_per_m;
  const double friction_limit_N = Table1::friction_coefficient * scene.normal_force_N;
  const double k = Table1::stiffness_N_per_m / Table1::inertia_N_per_m;
  const double sliding = 0.5 / (1.0 - k);
  const auto scalar = [](double x) { return static_cast<Scalar>(x); };
  const auto wide = [](Scalar x) { return static_cast<double>(x); };
  const Model model =
      Case()
          .contact_stiffness(scene.contact_stiffness_N_per_m * length_m / friction_limit_N)
          .friction_force(friction_limit_N / force_amplitude_N)
          .vibration_sign(scene.vibration_sign)
          .stiffness(k);
  auto solver = configured<typename Method::template Solver<Model>>(
      model, scalar(setting > 1.0 ? 2.0 * pi / setting : setting));
  State<Scalar> state;
  EnergyAccount<Scalar> first;
  EnergyAccount<Scalar> second;
  Error error = Error::none;
  for (EnergyAccount<Scalar>* half : {&first, &second}) {
    if (error == Error::none) {
      error = run_periods(solver, 50, Scalar(1), scalar(sliding), state, *half);
    }
  }
  const double half_run = 100.0 * pi;
  const double friction = wide(first.friction_integral) + wide(second.friction_integral);
  const double work = wide(first.friction_work) + wide(second.friction_work);
  return {{wide(state.displacement) * length_m,
           wide(state.velocity) * length_m * Table1::carrier_rad_per_s,
           wide(state.friction) * friction_limit_N, friction / (2.0 * half_run),
           wide(second.friction_integral) / half_run, work / (2.0 * half_run * sliding),
           wide(second.friction_work) / (half_run * sliding)},
          error};
}

template <class Method>
void expect_values(const Scene& scene, double setting, double relative_error) {
  const Run found = run<Method>(scene, setting);
  EXPECT_EQ(found.error, Error::none) << scene.name;
  expect_known(found.values, scene, relative_error);
}

/// Of friction and of dissipation, over the whole run.
template <class Method>
void expect_ratios(const Scene& scene, double setting, double relative_error) {
  const Run found = run<Method>(scene, setting);
  const Values expected = known(scene);
  EXPECT_EQ(found.error, Error::none) << scene.name;
  EXPECT_NEAR(found.values.friction_ratio / expected.friction_ratio, 1.0, relative_error)
      << scene.name << ' ' << setting;
  EXPECT_NEAR(found.values.dissipation_ratio / expected.dissipation_ratio, 1.0, relative_error)
      << scene.name << ' ' << setting;
}

TEST(ReferenceOpenLoop, Taylor) {
  for (const Scene& scene : open_loop::scenes) {
    expect_values<TaylorMethod<double, 16>>(scene, 1e-12, 1e-11);
    expect_values<TaylorMethod<double, 12>>(scene, 1e-9, 2e-8);
    expect_ratios<TaylorMethod<double, 8>>(scene, 1e-5, 1e-5);
    for (const double tolerance : {1e-6, 1e-8, 1e-9, 1e-10}) {
      expect_ratios<TaylorMethod<double, 12>>(scene, tolerance, tolerance);
    }
    expect_ratios<TaylorMethod<double, 16>>(scene, 1e-13, 1e-12);
    expect_ratios<TaylorMethod<float, 8>>(scene, 1e-7, 1e-5);
  }
}

/// Two of the scenes are weakly coupled: there a period is a panel.
TEST(ReferenceOpenLoop, Gauss) {
  for (const Scene& scene : open_loop::scenes) {
    expect_ratios<GaussMethod<double, 8>>(scene, 1e-6, 1e-6);
    expect_ratios<GaussMethod<double, 8>>(scene, 1e-8, 1e-8);
    expect_ratios<GaussMethod<double, 12>>(scene, 1e-10, 1e-10);
    expect_ratios<GaussMethod<float, 8>>(scene, 1e-7, 2e-5);
  }
}

/// The paper's step has seven digits where the contact is soft, loses some under heavy friction,
/// and breaks the friction bound in stiff contact.
TEST(ReferenceOpenLoop, Rk4) {
  for (const Scene& scene : {open_loop::table_1, open_loop::table_1_as_printed}) {
    expect_ratios<Rk4Method<double>>(scene, 1000.0, 1e-7);
    expect_ratios<Rk4Method<float>>(scene, 128.0, 1e-4);
    EXPECT_NEAR(
        run<Rk4Method<double>>(scene, 1000.0).values.displacement_m / known(scene).displacement_m,
        1.0, 1e-8);
  }
  expect_ratios<Rk4Method<double>>(open_loop::heavy_friction, 1000.0, 1e-5);
  EXPECT_GT(
      std::abs(run<Rk4Method<double>>(open_loop::heavy_friction, 1000.0).values.friction_ratio /
                   known(open_loop::heavy_friction).friction_ratio -
               1.0),
      1e-7);
  EXPECT_EQ(run<Rk4Method<double>>(open_loop::stiff_contact, 1000.0).error,
            Error::friction_bound_broken);
}

TEST(ReferenceOpenLoop, ThePapersStepIsAThousandthOfThePeriod) {
  const DahlModel<double> model = Case().contact_stiffness(1.0).friction_force(1.0).stiffness(1.0);
  auto solver = configured<Rk4<DahlModel<double>>>(model, 1.667e-8 * Table1::carrier_rad_per_s);
  advanced(solver, lasting(2.0 * pi).driven(1.0).sliding(0.5), {});
  EXPECT_EQ(solver.cost().steps, 1000U);
}

TEST(ReferenceOpenLoop, Rk4Event) {
  for (const Scene& scene : {open_loop::table_1, open_loop::table_1_as_printed}) {
    expect_ratios<Rk4EventMethod<double>>(scene, 16.0, 2e-5);
    expect_ratios<Rk4EventMethod<double>>(scene, 128.0, 5e-9);
    expect_ratios<Rk4EventMethod<double>>(scene, 1000.0, 5e-12);
    expect_ratios<Rk4EventMethod<float>>(scene, 64.0, 2e-5);
  }
  expect_ratios<Rk4EventMethod<double>>(open_loop::heavy_friction, 128.0, 5e-8);
  EXPECT_EQ(run<Rk4EventMethod<double>>(open_loop::stiff_contact, 1000.0).error,
            Error::step_too_long);
}

TEST(ReferenceOpenLoop, EqualStepStrang) {
  for (const Scene& scene : {open_loop::table_1, open_loop::table_1_as_printed}) {
    expect_ratios<EqualStepStrangMethod<double>>(scene, 8.0, 1e-4);
    expect_ratios<EqualStepStrangMethod<double>>(scene, 32.0, 2e-7);
    expect_ratios<EqualStepStrangMethod<double>>(scene, 512.0, 1e-11);
    expect_ratios<EqualStepStrangMethod<float>>(scene, 16.0, 2e-5);
  }
  expect_ratios<EqualStepStrangMethod<double>>(open_loop::stiff_contact, 16.0, 1e-4);
  expect_ratios<EqualStepStrangMethod<double>>(open_loop::stiff_contact, 512.0, 1e-6);
  expect_ratios<EqualStepStrangMethod<double>>(open_loop::heavy_friction, 32.0, 1e-3);
  expect_ratios<EqualStepStrangMethod<double>>(open_loop::heavy_friction, 512.0, 2e-6);
}

TEST(ReferenceOpenLoop, Strang) {
  for (const Scene& scene : open_loop::scenes) {
    expect_ratios<StrangMethod>(scene, 1e-3, 1e-3);
    expect_ratios<StrangMethod>(scene, 1e-5, 1e-5);
  }
}

}  // namespace
}  // namespace sonoglide::plant::reference_open_loop_test
