#include "host_sim/report/run_parts.hpp"
#include "host_sim/report/spectrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "tests/common/constants/pi.hpp"

namespace sonoglide::report::hysteresis_test {
namespace {

using tests::pi;
constexpr int samples_per_cycle = 64;
constexpr double amplitude_m = 1e-6;
constexpr double presliding_m = 0.35e-6;
constexpr double limit_N = 0.02;

/// A Dahl contact under prescribed motion: x = X sin(ωt + phase), sliding at a constant part of the
/// peak vibration velocity; ω = 1, several cycles from e = 0 on.
loop::Recording prescribed(double velocity_ratio, double sign, int cycles, double phase = 0.4) {
  loop::Recording recording;
  constexpr int substeps = 64;
  const double dt = 2.0 * pi / samples_per_cycle;
  double force_N = 0.0;
  for (int i = 0; i <= cycles * samples_per_cycle; ++i) {
    const double t = i * dt;
    recording.time_s.push_back(t);
    recording.state.push_back(
        {amplitude_m * std::sin(t + phase), amplitude_m * std::cos(t + phase), force_N});
    recording.drive_force_N.push_back(0.0);
    recording.sliding_velocity_m_per_s.push_back(velocity_ratio * amplitude_m);
    for (int k = 0; k < substeps; ++k) {
      const auto travelled = [&](double at) {
        return velocity_ratio * amplitude_m * at + sign * amplitude_m * std::sin(at + phase);
      };
      const double begin = t + k * dt / substeps;
      const double travel = travelled(begin + dt / substeps) - travelled(begin);
      const double s = travel < 0.0 ? -1.0 : 1.0;
      // e = 1 − s F/Fc decays with the travel.
      const double e = (1.0 - s * force_N / limit_N) * std::exp(-std::abs(travel) / presliding_m);
      force_N = s * limit_N * (1.0 - e);
    }
  }
  return recording;
}

double span(const Branch& branch) {
  const auto [low, high] =
      std::minmax_element(branch.displacement_m.begin(), branch.displacement_m.end());
  return *high - *low;
}

/// Work done on the contact along a branch, by the trapezoidal rule.
double work(const Branch& branch) {
  double sum = 0.0;
  for (std::size_t i = 1; i < branch.force_N.size(); ++i) {
    sum += 0.5 * (branch.force_N[i] + branch.force_N[i - 1]) *
           (branch.displacement_m[i] - branch.displacement_m[i - 1]);
  }
  return sum;
}

/// Travel forward during one cycle, in X: the integral of the positive part of r + cos θ.
double forward_travel(double velocity_ratio) {
  const double turn = std::acos(-velocity_ratio);
  return 2.0 * (velocity_ratio * turn + std::sqrt(1.0 - velocity_ratio * velocity_ratio));
}

class HysteresisLoopTest : public testing::TestWithParam<double> {};

TEST_P(HysteresisLoopTest, IsOneCycleOfTheContact) {
  const double sign = GetParam();
  const auto convention =
      sign > 0.0 ? scene::SignConvention::dissipative : scene::SignConvention::as_printed;
  const double ratio = 0.5;
  const HysteresisLoop loop = last_cycle(prescribed(ratio, sign, 6), convention, samples_per_cycle);
  EXPECT_EQ(loop.forward.force_N.size() + loop.backward.force_N.size(),
            static_cast<std::size_t>(samples_per_cycle + 1));
  ASSERT_EQ(loop.forward.displacement_m.size(), loop.forward.force_N.size());
  ASSERT_EQ(loop.backward.displacement_m.size(), loop.backward.force_N.size());
  // Ends are within a sample of the reversals, where the contact hardly moves.
  const double forward_m = forward_travel(ratio) * amplitude_m;
  EXPECT_NEAR(span(loop.forward), forward_m, 0.01 * forward_m);
  EXPECT_NEAR(span(loop.backward), forward_m - 2.0 * pi * ratio * amplitude_m, 0.01 * forward_m);
  EXPECT_EQ(loop.forward.displacement_m.front(), 0.0);
}

TEST_P(HysteresisLoopTest, BranchesAreMonotoneAndFollowTheirDirection) {
  const double sign = GetParam();
  const auto convention =
      sign > 0.0 ? scene::SignConvention::dissipative : scene::SignConvention::as_printed;
  const HysteresisLoop loop = last_cycle(prescribed(0.3, sign, 6), convention, samples_per_cycle);
  const auto& forward = loop.forward;
  for (std::size_t i = 2; i + 1 < forward.force_N.size(); ++i) {
    EXPECT_GT(forward.displacement_m[i], forward.displacement_m[i - 1]) << i;
    EXPECT_GT(forward.force_N[i], forward.force_N[i - 1]) << i;
  }
  const auto& backward = loop.backward;
  for (std::size_t i = 1; i < backward.force_N.size(); ++i) {
    EXPECT_LT(backward.displacement_m[i], backward.displacement_m[i - 1]) << i;
    EXPECT_LT(backward.force_N[i], backward.force_N[i - 1]) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Signs, HysteresisLoopTest, testing::Values(1.0, -1.0),
                         [](const auto& sign) {
                           return sign.param > 0.0 ? "dissipative" : "as_printed";
                         });

TEST(HysteresisTest, ASymmetricLoopCloses) {
  const HysteresisLoop loop =
      last_cycle(prescribed(0.0, 1.0, 8), scene::SignConvention::dissipative, samples_per_cycle);
  // Closed Dahl loop of half width X: the branch runs between ± Fc tanh(X/presliding).
  const double reach_N = limit_N * std::tanh(amplitude_m / presliding_m);
  const auto [low, high] =
      std::minmax_element(loop.forward.force_N.begin(), loop.forward.force_N.end());
  EXPECT_NEAR(*high, reach_N, 0.01 * limit_N);
  EXPECT_NEAR(*low, -reach_N, 0.05 * limit_N);
  EXPECT_NEAR(loop.forward.displacement_m.back(), 2.0 * amplitude_m, 0.01 * amplitude_m);
  EXPECT_NEAR(loop.backward.displacement_m.back(), 0.0, 0.01 * amplitude_m);
  // Its area is that of the two exponentials, 4 Fc (X − p tanh(X/p)).
  const double area =
      4.0 * limit_N * (amplitude_m - presliding_m * std::tanh(amplitude_m / presliding_m));
  EXPECT_NEAR((work(loop.forward) + work(loop.backward)) / area, 1.0, 0.01);
}

TEST(HysteresisTest, WithoutReversalIsTheEndOfTheRecordingAsOneBranch) {
  const HysteresisLoop loop =
      last_cycle(prescribed(1.5, 1.0, 3), scene::SignConvention::dissipative, samples_per_cycle);
  EXPECT_EQ(loop.forward.force_N.size(), static_cast<std::size_t>(samples_per_cycle + 1));
  EXPECT_TRUE(loop.backward.force_N.empty());
  EXPECT_NEAR(loop.forward.displacement_m.back(), 1.5 * 2.0 * pi * amplitude_m, 1e-9 * amplitude_m);
}

TEST(HysteresisTest, TakesWhatThereIs) {
  const scene::SignConvention convention = scene::SignConvention::dissipative;
  EXPECT_TRUE(last_cycle({}, convention, samples_per_cycle).forward.force_N.empty());
  const HysteresisLoop one = last_cycle(prescribed(0.5, 1.0, 0), convention, samples_per_cycle);
  EXPECT_EQ(one.forward.force_N.size(), 1U);
  const HysteresisLoop half = last_cycle(prescribed(1.5, 1.0, 1), convention, 1000);
  EXPECT_EQ(half.forward.force_N.size(), static_cast<std::size_t>(samples_per_cycle + 1));
}

/// What the page says of a cycle at the end of a run.
std::string note_of(const loop::Recording& recording) {
  scene::Scene scene;
  scene.friction.coefficient = 0.1;
  scene.friction.normal_force_N = 0.2;
  return ending_section(scene, recording).charts.at(0).note;
}

TEST(HysteresisTest, ThePageSaysWhyACycleDoesNotClose) {
  const std::string cycle = "One cycle of the contact, at the end of the run. ";
  EXPECT_EQ(note_of(prescribed(0.0, 1.0, 6)), cycle);
  // 2 pi r X in each.
  EXPECT_EQ(note_of(prescribed(0.5, 1.0, 6)),
            cycle +
                "It does not close. The sliding carries the contact 3.142 um further in each "
                "carrier period.");
  EXPECT_EQ(note_of(prescribed(1.5, 1.0, 6)),
            cycle +
                "The contact slides forward all the time: there is no way back, so the curve "
                "does not close.");
}

TEST(HysteresisTest, ThePageTellsAVibrationThatIsNotSettledFromTheSliding) {
  loop::Recording drifts = prescribed(0.0, 1.0, 6);
  const double begin_s = drifts.time_s[drifts.time_s.size() - samples_per_cycle - 1];
  for (std::size_t i = 0; i < drifts.state.size(); ++i) {
    drifts.state[i].displacement_m += 1e-7 * (drifts.time_s[i] - begin_s) / (2.0 * pi);
  }
  EXPECT_EQ(note_of(drifts),
            "One cycle of the contact, at the end of the run. It does not close. The vibration is "
            "not settled, and moves the contact by 100 nm in this one.");
}

}  // namespace
}  // namespace sonoglide::report::hysteresis_test
