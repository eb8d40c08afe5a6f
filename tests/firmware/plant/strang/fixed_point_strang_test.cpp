/// The plant in integers against the plant in double.

#include "firmware/plant/strang/fixed_point_strang.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/friction/dahl.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/contact.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "firmware/plant/strang/fixed_point_strang_design.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/firmware/plant/runs/case.hpp"
#include "tests/firmware/plant/runs/course.hpp"

namespace sonoglide::plant::fixed_point_strang_test {
namespace {

using tests::two_pi;

using Model = plant::Model<friction::Dahl<double>, Damped<double>, CosineDrive>;

/// Table 1 with 1920 N at most, sliding at 26.72 mm/s.
constexpr double full_drive_N = 1920.0;
constexpr tests::DimensionlessTable1 numbers(full_drive_N);
const Model table_1 = Case()
                          .contact_stiffness(numbers.contact_stiffness)
                          .friction_force(numbers.friction_force)
                          .stiffness(numbers.stiffness);
constexpr double table_1_drive = 1.0;
constexpr double table_1_sliding =
    0.02672 * tests::Table1::inertia_N_per_m / (full_drive_N * tests::Table1::carrier_rad_per_s);

double mean_friction(FixedStrang& plant, double amplitude) {
  return static_cast<double>(plant.advance(numeric::to_code(amplitude))) * 0x1p-36;
}

/// The same in double, steps enough to be as good as exact here.
class DoublePlant {
 public:
  DoublePlant(const Model& model, double full_drive, double sliding_velocity, double steps,
              const State<double>& initial = {})
      : full_drive_(full_drive), sliding_velocity_(sliding_velocity), state_(initial) {
    solver_.configure(model, two_pi / steps);
  }

  double mean_friction(double amplitude) {
    MeanFriction<double> account;
    NoObserver nobody;
    solver_.advance(lasting(two_pi).driven(amplitude * full_drive_).sliding(sliding_velocity_),
                    state_, account, nobody);
    return account.friction_integral / two_pi;
  }

 private:
  double full_drive_;
  double sliding_velocity_;
  State<double> state_;
  EqualStepStrang<Model> solver_;
};

FixedStrang designed(const Model& model, double full_drive, double sliding_velocity,
                     const State<double>& initial = {}) {
  const FixedStrangDesign design =
      design_fixed_strang(model, full_drive, sliding_velocity, initial);
  EXPECT_EQ(design.refusal, FixedStrangRefusal::none);
  return FixedStrang(design.parameters);
}

struct Deviation {
  double largest = 0.0;
  double mean = 0.0;
};

/// Under a drive that changes every 200 periods.
Deviation deviation(double full, int periods, double steps) {
  FixedStrang fixed = designed(table_1, table_1_drive, table_1_sliding);
  DoublePlant exact(table_1, table_1_drive, table_1_sliding, steps);
  Deviation result;
  for (int k = 0; k < periods; ++k) {
    const double amplitude = full * (k / 200 % 2 == 0 ? 0.4 : 0.6);
    const double error = mean_friction(fixed, amplitude) - exact.mean_friction(amplitude);
    result.largest = std::max(result.largest, std::abs(error));
    result.mean += error / periods;
  }
  EXPECT_EQ(fixed.saturations(), 0U);
  return result;
}

TEST(FixedStrangTest, IsAsGoodAsItsDocumentationSaysAtAnyDriveAmplitude) {
  for (const double full : {0.05, 0.1, 0.15, 0.2, 0.25, 0.35, 0.5, 0.75, 1.0}) {
    const Deviation found = deviation(full, 1600, 24.0);
    EXPECT_LE(found.largest, 4e-4) << full;
    EXPECT_LE(std::abs(found.mean), 2e-5) << full;
  }
}

TEST(FixedStrangTest, IsAsGoodAfterAHundredThousandPeriods) {
  const Deviation found = deviation(0.25, 100000, 10.0);
  EXPECT_LE(found.largest, 4e-4);
  EXPECT_LE(std::abs(found.mean), 2e-5);
}

TEST(FixedStrangTest, WithoutDriveFrictionTendsToItsLimit) {
  FixedStrang plant = designed(table_1, table_1_drive, table_1_sliding);
  double last = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double friction = mean_friction(plant, 0.0);
    EXPECT_GE(friction, last);
    EXPECT_LE(friction, 1.0);
    last = friction;
  }
  EXPECT_NEAR(last, 1.0, 5e-8);
}

TEST(FixedStrangTest, FollowsDampingTheSignAsPrintedAndAnInitialState) {
  const Model printed = Case()
                            .contact_stiffness(1.5)
                            .friction_force(2e-3)
                            .vibration_sign(-1.0)
                            .damping(0.02)
                            .stiffness(0.3);
  const State<double> initial{0.4, -0.2, 0.5};
  FixedStrang fixed = designed(printed, 0.7, -0.2, initial);
  DoublePlant exact(printed, 0.7, -0.2, 64.0, initial);
  for (int k = 0; k < 300; ++k) {
    const double amplitude = k < 150 ? 0.3 : 0.7;
    EXPECT_NEAR(mean_friction(fixed, amplitude), exact.mean_friction(amplitude), 1e-3) << k;
  }
}

RC_GTEST_PROP(FixedStrangTest, StaysInBoundsWhateverTheContactAndTheDrive, ()) {
  const double kappa = std::exp2(*rc::gen::inRange(-60, 60) / 10.0);
  const double sliding = *rc::gen::inRange(-190, 190) / 100.0;
  const double stiffness = *rc::gen::inRange(0, 80) / 100.0;
  const Model model = Case().contact_stiffness(kappa).friction_force(1e-4).stiffness(stiffness);
  FixedStrang fixed = designed(model, 1.0, sliding);
  for (int k = 0; k < 50; ++k) {
    const auto code = static_cast<std::int32_t>(*rc::gen::arbitrary<std::uint32_t>() >> 1U);
    const double friction = static_cast<double>(fixed.advance(code)) * 0x1p-36;
    RC_ASSERT(std::abs(friction) <= 1.0 + 1e-6);
  }
}

RC_GTEST_PROP(FixedStrangTest, FollowsTheDoublePlantInAnyOrdinaryContact, ()) {
  const double kappa = std::exp2(*rc::gen::inRange(-40, 20) / 10.0);
  const double sliding = *rc::gen::inRange(-150, 150) / 100.0;
  const double stiffness = *rc::gen::inRange(0, 50) / 100.0;
  const double amplitude = *rc::gen::inRange(0, 1000) / 1000.0;
  const Model model = Case().contact_stiffness(kappa).friction_force(1e-5).stiffness(stiffness);
  FixedStrang fixed = designed(model, 1.0, sliding);
  DoublePlant exact(model, 1.0, sliding, 64.0);
  const double step = two_pi / 32.0;
  double allowed = 2e-3 + step * step * kappa * std::abs(sliding) / (12.0 * two_pi);
  for (int k = 0; k < 60; ++k) {
    RC_ASSERT(std::abs(mean_friction(fixed, amplitude) - exact.mean_friction(amplitude)) < allowed);
    allowed = 2e-3;
  }
}

TEST(FixedStrangTest, CountsEverySaturation) {
  FixedStrangParameters small =
      design_fixed_strang(table_1, table_1_drive, table_1_sliding, {}).parameters;
  for (auto& driven : small.driven) {
    driven = {8 * driven[0], 8 * driven[1]};  // a state scale that is eight times too small
  }
  FixedStrang plant(small);
  plant.advance(INT32_MAX / 16);
  EXPECT_EQ(plant.saturations(), 0U);
  plant.advance(INT32_MAX);
  const std::uint32_t once = plant.saturations();
  EXPECT_GT(once, 0U);
  const double friction = mean_friction(plant, 0.99);
  EXPECT_GT(plant.saturations(), once);
  EXPECT_LE(std::abs(friction), 1.0 + 1e-6);
}

TEST(FixedStrangTest, IsRefusedWhereTheIntegersEnd) {
  const auto refusal = [](const Model& model, double sliding, const State<double>& initial) {
    return design_fixed_strang(model, table_1_drive, sliding, initial).refusal;
  };
  EXPECT_EQ(refusal(table_1, 0.1, {}), FixedStrangRefusal::none);
  Model model = table_1;
  model.stiffness = 1.3;
  EXPECT_EQ(refusal(model, 0.1, {}), FixedStrangRefusal::oscillator);
  model = table_1;
  model.damping = 1.3;
  EXPECT_EQ(refusal(model, 0.1, {}), FixedStrangRefusal::oscillator);
  model = table_1;
  model.law.contact_stiffness = 300.0;
  EXPECT_EQ(refusal(model, 0.1, {}), FixedStrangRefusal::contact);
  model = table_1;
  model.friction_force = 0.1;
  EXPECT_EQ(refusal(model, 0.1, {}), FixedStrangRefusal::friction);
  EXPECT_EQ(refusal(table_1, 5.0, {}), FixedStrangRefusal::range);
  EXPECT_EQ(refusal(table_1, 0.1, {9.0, 0.0, 0.0}), FixedStrangRefusal::range);
  EXPECT_EQ(refusal(table_1, 0.1, {0.0, 9.0, 0.0}), FixedStrangRefusal::range);
}

}  // namespace
}  // namespace sonoglide::plant::fixed_point_strang_test
