#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "host_sim/runs/batch/run_dahl_plants.hpp"

namespace sonoglide::batch::given_up_test {
namespace {

RunStatus status_of(const DahlPlant& plant) {
  return run_dahl_plants({plant}, {10, 0}, Accuracy::fine)[0].status;
}

TEST(GivenUp, ParametersThatTheLanesAreNotMadeFor) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  DahlPlant plant;
  EXPECT_EQ(status_of(plant), RunStatus::solved);
  for (double DahlPlant::*parameter :
       {&DahlPlant::drive_amplitude, &DahlPlant::damping, &DahlPlant::stiffness,
        &DahlPlant::friction_force, &DahlPlant::contact_stiffness, &DahlPlant::sliding_velocity,
        &DahlPlant::vibration_sign}) {
    DahlPlant spoilt;
    spoilt.*parameter = nan;
    EXPECT_EQ(status_of(spoilt), RunStatus::outside_range);
    spoilt.*parameter = std::numeric_limits<double>::infinity();
    EXPECT_EQ(status_of(spoilt), RunStatus::outside_range);
  }
  plant.stiffness = -0.1;
  EXPECT_EQ(status_of(plant), RunStatus::outside_range);
  plant = DahlPlant();
  plant.contact_stiffness = 0.0;
  EXPECT_EQ(status_of(plant), RunStatus::outside_range);
  plant = DahlPlant();
  plant.vibration_sign = 0.5;
  EXPECT_EQ(status_of(plant), RunStatus::outside_range);
  plant = DahlPlant();
  plant.initial.friction = 1.5;
  EXPECT_EQ(status_of(plant), RunStatus::outside_range);
}

TEST(GivenUp, RestWithoutAcceleration) {
  DahlPlant plant;
  plant.drive_amplitude = 0.0;
  EXPECT_EQ(status_of(plant), RunStatus::undecided_reversal);
}

TEST(GivenUp, RestWithAccelerationIsDecided) {
  DahlPlant plant;
  plant.sliding_velocity = 0.0;
  EXPECT_EQ(status_of(plant), RunStatus::solved);
}

TEST(GivenUp, TooStiffForTheNumberOfSteps) {
  DahlPlant plant;
  plant.contact_stiffness = 1e9;
  plant.friction_force = 10.0;
  plant.sliding_velocity = 0.1;
  EXPECT_EQ(status_of(plant), RunStatus::too_many_steps);
}

TEST(GivenUp, MotionBeyondTheRange) {
  DahlPlant plant;
  plant.drive_amplitude = 0.9e15;
  EXPECT_EQ(status_of(plant), RunStatus::not_finite);
}

}  // namespace
}  // namespace sonoglide::batch::given_up_test
