/// The witness sees what is wrong with a step, and nothing where nothing is.

#include "host_sim/studies/stability/trial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "firmware/friction/none.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"

namespace sonoglide::stability::witness_test {
namespace {

using State = plant::State<double>;
using FreeModel = plant::Model<friction::None<double>, plant::Undamped<double>, plant::CosineDrive>;

/// A step that does as it is told.
struct ToldStep {
  State last;
  double drive = 0.0;
  double velocity_square = 0.0;

  double length() const { return 1.0; }
  State at(double /*offset*/) const { return last; }
  double friction_integral() const { return last.friction; }
  double friction_work() const { return 0.0; }
  double sliding_work() const { return 0.0; }
  plant::MotionIntegrals<double> motion_integrals() const {
    return {drive, velocity_square, 0.0, 0.0};
  }
};

constexpr State rest{};
constexpr State moving{0.0, 2.0, 0.0};

TEST(Witness, FindsNothingWhereTheEnergyAddsUp) {
  Witness witness;
  witness.add(ToldStep{moving, 2.0});
  EXPECT_EQ(witness.balance_residual(FreeModel{}, rest, moving), 0.0);
}

TEST(Witness, MeasuresWhatIsMissingAgainstWhatPassed) {
  Witness witness;
  witness.add(ToldStep{moving, 1.5});
  EXPECT_DOUBLE_EQ(witness.balance_residual(FreeModel{}, rest, moving), 0.25);
}

TEST(Witness, WorksThatCancelStillCountAsPassed) {
  Witness witness;
  witness.add(ToldStep{rest, 1e3});
  witness.add(ToldStep{rest, -1e3 + 1e-10});
  EXPECT_LT(witness.balance_residual(FreeModel{}, rest, rest), 1e-12);
}

/// A free mass that the drive has set in motion and stopped again within one step.
TEST(Witness, WhatAStepStoredBetweenItsEndsCounts) {
  Witness witness;
  witness.add(ToldStep{rest, 1e-10, 1.0});
  EXPECT_DOUBLE_EQ(witness.balance_residual(FreeModel{}, rest, rest), 2e-10);
}

TEST(Witness, NothingPassedNothingMissing) {
  Witness witness;
  witness.add(ToldStep{rest});
  EXPECT_EQ(witness.balance_residual(FreeModel{}, rest, rest), 0.0);
}

TEST(Witness, KeepsTheLargestFriction) {
  Witness witness;
  witness.add(ToldStep{{0.0, 0.0, -1.5}});
  witness.add(ToldStep{{0.0, 0.0, 0.5}});
  EXPECT_EQ(witness.largest_friction(), 1.5);
}

TEST(Witness, DoesNotPassOverAFrictionThatIsNoNumber) {
  Witness witness;
  witness.add(ToldStep{{0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}});
  EXPECT_TRUE(std::isnan(witness.largest_friction()));
}

}  // namespace
}  // namespace sonoglide::stability::witness_test
