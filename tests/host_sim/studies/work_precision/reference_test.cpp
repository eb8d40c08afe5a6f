/// The reference against values of 25 digits that other programs computed.
#include "host_sim/studies/work_precision/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host_sim/studies/work_precision/gragg_bulirsch_stoer.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/studies/work_precision/peers/published/published_problems.hpp"

namespace sonoglide::work_precision::reference_test {
namespace {

TEST(GraggBulirschStoerTest, FollowsAnOscillatorOverOneRadian) {
  const auto oscillator = [](long double /*t*/, const Vector<2>& x) {
    return Vector<2>{x[1], -x[0]};
  };
  const Vector<2> begin{1.0L, 0.0L};
  const Extrapolated<2> end = gragg_bulirsch_stoer(oscillator, 0.0L, begin, 1.0L, 10);
  EXPECT_NEAR(static_cast<double>(end.value[0] - std::cos(1.0L)), 0.0, 1e-16);
  EXPECT_NEAR(static_cast<double>(end.value[1] + std::sin(1.0L)), 0.0, 1e-16);
}

TEST(GraggBulirschStoerTest, ItsErrorEstimateBoundsTheError) {
  const auto growth = [](long double t, const Vector<1>& x) { return Vector<1>{t * x[0]}; };
  for (int columns = 2; columns <= 6; ++columns) {
    const Extrapolated<1> end = gragg_bulirsch_stoer(growth, 0.0L, Vector<1>{1.0L}, 1.0L, columns);
    EXPECT_LT(std::abs(end.value[0] - std::exp(0.5L)), end.error) << columns;
  }
}

class ReferenceTest : public testing::TestWithParam<std::string> {};

TEST_P(ReferenceTest, AgreesWithTheKnownOutcome) {
  const CheckedReference computed = checked_reference(peers::published_problem(GetParam()));
  const peers::PublishedOutcome known = peers::published_outcome(GetParam());
  const auto relative = [](long double a, long double b) {
    return static_cast<double>(std::abs(a / b - 1.0L));
  };
  EXPECT_LT(relative(computed.motion.friction_ratio, known.friction_ratio), 2e-15);
  // The end state is the more sensitive to the rounding of the problem's numbers.
  EXPECT_LT(relative(computed.motion.displacement, known.displacement), 1e-12);
  EXPECT_LT(relative(computed.motion.velocity, known.velocity), 1e-12);
  EXPECT_LT(relative(computed.motion.friction, known.friction), 1e-12);
  EXPECT_LT(static_cast<double>(computed.error), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Published, ReferenceTest, testing::ValuesIn(peers::published_names()),
                         [](const auto& name) { return name.param; });

TEST(ReferenceTest, ASlidingThatNeverReversesKeepsItsFriction) {
  peers::Problem problem = peers::published_problem("stiff_contact");
  problem.sliding_velocity = 5.0;
  problem.friction = 1.0;
  problem.periods = 3;
  const CheckedReference computed = checked_reference(problem);
  EXPECT_NEAR(static_cast<double>(computed.motion.friction_ratio), 1.0, 1e-15);
}

TEST(ReferenceTest, WithoutDriveTheContactStartsUpAsDahlSays) {
  // A mass that the contact cannot move slides r tau: phi = 1 - exp(-kappa r tau).
  peers::Problem problem{};
  problem.contact_stiffness = 0.3;
  problem.friction_force = 0.0;
  problem.vibration_sign = 1.0;
  problem.sliding_velocity = 0.7;
  problem.periods = 2;
  const CheckedReference computed = checked_reference(problem);
  const long double z = 0.3L * 0.7L * 4.0L * tests::long_pi;
  EXPECT_NEAR(static_cast<double>(computed.motion.friction_ratio),
              static_cast<double>(1.0L + std::expm1(-z) / z), 1e-15);
}

}  // namespace
}  // namespace sonoglide::work_precision::reference_test
