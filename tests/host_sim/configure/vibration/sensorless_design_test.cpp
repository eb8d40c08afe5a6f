#include "host_sim/configure/vibration/sensorless_design.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/control/vibration/sensorless_table.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/configure/vibration/mode_model.hpp"
#include "spectral_radius.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::configure::sensorless_design_test {
namespace {

using Index = control::SensorlessIndex;

using tests::pi;
using tests::with_natural_frequency;

constexpr double velocity_m_per_s = 4.0;

/// Largest modulus of the poles of a mode under the feedback that the table has at its place.
double slowest_pole(const SensorlessDesign& design, double frequency_parameter, double stiffness) {
  control::SensorlessInterpolation<double> row(design.table);
  row.go(frequency_parameter);
  const ModeModel model =
      mode_model({stiffness * (1.0 + frequency_parameter * design.stiffness_range), 0.0, 1.0});
  Eigen::Vector3d change;
  change << row[Index::input_gain], row[Index::input_gain + 1], 1.0;
  Eigen::RowVector3d feedback;
  feedback << row[Index::feedback], row[Index::feedback + 1], row[Index::feedback + 2];
  Eigen::Matrix3d loop = Eigen::Matrix3d::Identity();
  loop.topLeftCorner<2, 2>() = model.rotation;
  loop -= change * feedback;
  return spectral_radius(loop);
}

/// Next to half a turn in a period the feedback changes faster than the rows lie.
TEST(SensorlessDesignTest, NoModeGrowsAtOrBetweenTheRows) {
  for (const double mode : {0.2163, 0.5, 0.7, 1.48, 1.5, 2.5, 3.46, 3.469, 3.5, 3.52, 10.5}) {
    const scene::Scene scene = with_natural_frequency(mode);
    const SensorlessDesign design =
        design_sensorless(scene, nominal_plant(scene), velocity_m_per_s);
    const double angle = 2.0 * pi * mode;
    for (int i = -200; i <= 200; ++i) {
      const double frequency_parameter = 0.00499 * i;
      ASSERT_LT(slowest_pole(design, frequency_parameter, angle * angle), 1.001)
          << mode << ' ' << frequency_parameter;
    }
  }
}

TEST(SensorlessDesignTest, AModeWithoutDampingKeepsItsSizeBetweenTheRows) {
  for (const double mode : {0.2163, 1.3, 3.469, 10.5}) {
    const scene::Scene scene = with_natural_frequency(mode);
    const SensorlessDesign design =
        design_sensorless(scene, nominal_plant(scene), velocity_m_per_s);
    control::SensorlessInterpolation<double> row(design.table);
    for (int i = -200; i <= 200; ++i) {
      const double frequency_parameter = 0.00499 * i;
      row.go(frequency_parameter);
      const double angle =
          2.0 * pi * mode * std::sqrt(1.0 + frequency_parameter * design.stiffness_range);
      EXPECT_NEAR(row[Index::rotation], std::cos(angle), 4e-3)
          << mode << ' ' << frequency_parameter;
      EXPECT_NEAR(row[Index::rotation + 1], std::sin(angle), 4e-3)
          << mode << ' ' << frequency_parameter;
      EXPECT_NEAR(std::hypot(row[Index::rotation], row[Index::rotation + 1]), 1.0, 2e-4)
          << mode << ' ' << frequency_parameter;
    }
  }
}

/// From the steady vibration alone to a mode that rings with 1.2 times its displacement.
TEST(SensorlessDesignTest, AModeThatIsOneWithTheVibrationCountsAsAGain) {
  for (const double mode : {1.996, 2.0, 3.004}) {
    scene::Scene scene = with_natural_frequency(mode);
    const SensorlessDesign design =
        design_sensorless(scene, nominal_plant(scene), velocity_m_per_s);
    ASSERT_FALSE(design.apart) << mode;
    const control::SensorlessRow<double>& first = design.table[0];
    const control::SensorlessRow<double>& last = design.table[Index::rows - 1];
    EXPECT_NEAR(last[Index::forced] / first[Index::forced], 1.2 * std::hypot(1.0, mode), 1e-9);
    for (const control::SensorlessRow<double>& row : design.table) {
      EXPECT_EQ(row[Index::input_gain], 0.0);
      EXPECT_EQ(row[Index::input_gain + 1], 0.0);
      EXPECT_EQ(row[Index::plain + Index::Node::output], 0.0);
      EXPECT_NEAR(row[Index::per_velocity] * row[Index::forced], 1.0, 1e-12);
    }
    // Damping tells it: it dies within fewer than 20 periods.
    scene.plant.damping_N_s_per_m = 0.1 * scene.plant.mass_kg * scene.drive->frequency_Hz * 1.01;
    EXPECT_TRUE(design_sensorless(scene, nominal_plant(scene), velocity_m_per_s).apart) << mode;
  }
  for (const double mode : {0.995, 1.994, 2.006}) {
    const scene::Scene scene = with_natural_frequency(mode);
    EXPECT_TRUE(design_sensorless(scene, nominal_plant(scene), velocity_m_per_s).apart) << mode;
  }
}

}  // namespace
}  // namespace sonoglide::configure::sensorless_design_test
