/// What the panels of the Gauss method are built of: the motions, and their reversals.

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/plant/gauss/panel_motions.hpp"
#include "firmware/plant/gauss/panel_reversals.hpp"
#include "tests/firmware/plant/runs/motion.hpp"

namespace sonoglide::plant::panel_tables_test {
namespace {

TEST(PanelMotions, AreThoseOfTheOscillator) {
  using Damped = DampedDahlModel<double>;
  const Damped model = Case().contact_stiffness(1.0).damping(0.3).stiffness(0.7);
  using Motions = PanelMotions<Damped, 19, 9>;
  const Motions motions(model, pi);
  auto taylor = configured<EventTaylor<Damped, 16>>(model, 1e-15);
  // A panel from x = -1 under cos(tau): what is left of the two free motions at its end.
  const State<double> before = {0.4, -0.3, 0.0};
  const State<double> end = advanced(taylor, lasting(2.0 * pi).driven(1.0), before);
  const auto& begin = motions.begin;
  const double y = before.displacement + begin[2].value;  // cos(tau) = -cos(pi x)
  const double rate = pi * before.velocity + begin[2].rate;
  const double c =
      motions.unwound(y * begin[1].rate - rate * begin[1].value, begin[0].value, begin[1].value);
  const double s =
      motions.unwound(rate * begin[0].value - y * begin[0].rate, begin[0].value, begin[1].value);
  EXPECT_NEAR(c * motions.end[0].value + s * motions.end[1].value - motions.end[2].value,
              end.displacement, 1e-12);
  EXPECT_NEAR(c * motions.end[0].rate + s * motions.end[1].rate - motions.end[2].rate,
              pi * end.velocity, 1e-12);
}

/// V = level + cos(pi x) on the grid.
PanelReversals<double> reversals_of(double level, bool& certain) {
  GridVelocity<double> grid{};
  for (std::size_t g = 0; g < PanelGrid::points; ++g) {
    const double x = static_cast<double>(g) / 8.0 - 1.0;
    grid.velocity[g / 2][g % 2] = level + std::cos(pi * x);
  }
  const auto slope = [](std::size_t g) {
    return -pi * std::sin(pi * (static_cast<double>(g) / 8.0 - 1.0));
  };
  const double hidden = PanelGrid::hidden<double>;
  PanelReversals<double> found;
  certain = grid.find(hidden * pi * pi, hidden * pi * pi * pi, slope, found);
  return found;
}

TEST(GridVelocity, FindsReversals) {
  for (const double level : {-0.9, -0.5, 0.1, 0.77, 0.9}) {
    bool certain = false;
    const PanelReversals<double> found = reversals_of(level, certain);
    EXPECT_TRUE(certain);
    EXPECT_EQ(found.direction, -1.0);
    ASSERT_EQ(found.count, 2U);
    EXPECT_NEAR(found.at[0], -std::acos(-level) / pi, 1e-4);
    EXPECT_NEAR(found.at[1], std::acos(-level) / pi, 1e-4);
  }
}

TEST(GridVelocity, FindsNoneWhereThereIsNone) {
  bool certain = false;
  EXPECT_EQ(reversals_of(1.1, certain).count, 0U);
  EXPECT_TRUE(certain);
  EXPECT_EQ(reversals_of(-1.1, certain).count, 0U);
  EXPECT_TRUE(certain);
}

TEST(GridVelocity, SaysWhereItCannotTell) {
  for (const double level : {1.0, 1.01, -1.01, -1.0, 0.999}) {
    bool certain = true;
    reversals_of(level, certain);
    EXPECT_FALSE(certain) << level;
  }
}

}  // namespace
}  // namespace sonoglide::plant::panel_tables_test
