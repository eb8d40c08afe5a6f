#include "firmware/control/friction/map_slopes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "design.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "scalars.hpp"

namespace sonoglide::control::map_slopes_test {
namespace {

template <class S>
class MapSlopesTest : public testing::Test {};
TYPED_TEST_SUITE(MapSlopesTest, Scalars);

constexpr double speed = 0.1;
constexpr double friction_force = 0.3;

double log_ratio(double velocity, double contact_force) {
  return std::log(
      friction::dahl_friction_ratio(speed / velocity, contact_force * velocity / friction_force));
}

/// Against differences of the map itself.
TYPED_TEST(MapSlopesTest, AreThoseOfTheMap) {
  using S = TypeParam;
  for (const double contact_force : {0.3, 1.0, 6.0}) {
    Design design;
    design.contact_force = contact_force;
    typename TrackedDahlFeedforward<S>::Parameters parameters{};
    fill<S>(design, parameters);
    TrackedDahlFeedforward<S> map(parameters);
    const auto one = numeric::rescaled(numeric::floating(scaled<S>(0.5)), 1);
    map.set_friction(FrictionLevel<S>(scaled<S>(friction_force)), one, one);
    for (const double ratio : {0.3, 0.5, 0.7, 0.85}) {
      const double velocity =
          numeric::to_real(map.amplitude(scaled<S>(ratio / 2.0), scaled<S>(speed)));
      if (velocity > 0.9) {
        continue;
      }
      constexpr double part = 1e-4;
      const double of_velocity = (log_ratio(velocity * (1.0 + part), contact_force) -
                                  log_ratio(velocity * (1.0 - part), contact_force)) /
                                 (2.0 * part);
      const double of_stiffness = (log_ratio(velocity, contact_force * (1.0 + part)) -
                                   log_ratio(velocity, contact_force * (1.0 - part))) /
                                  (2.0 * part);
      MapSlopes<S> slopes;
      slopes.begin(scaled<S>(ratio / 2.0), map, scaled<S>(speed));
      const S half = slopes.of_velocity(map, scaled<S>(speed));
      EXPECT_NEAR(2.0 * numeric::to_real(half), of_velocity, 0.06 * std::abs(of_velocity) + 0.01)
          << contact_force << " " << ratio;
      EXPECT_NEAR(2.0 * numeric::to_real(slopes.of_stiffness(map, scaled<S>(speed), half)),
                  of_stiffness, 0.15 * std::abs(of_stiffness) + 0.01)
          << contact_force << " " << ratio;
    }
  }
}

/// What is not below 0 says that there is none.
TYPED_TEST(MapSlopesTest, BeyondTheLargestDriveThereIsNone) {
  using S = TypeParam;
  const CoulombFeedforward<S> map({});
  MapSlopes<S> slopes;
  slopes.begin(scaled<S>(0.1), map, scaled<S>(0.9));
  EXPECT_GT(slopes.of_velocity(map, scaled<S>(0.9)), S{});
}

}  // namespace
}  // namespace sonoglide::control::map_slopes_test
