/// The harmonics of a texture, against those that made-up periods are made of.
#include "host_sim/report/texture_metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "tests/common/table_1.hpp"

namespace sonoglide::report::texture_metrics_test {
namespace {

using tests::pi;

constexpr double period_m = 1e-3;

scene::Scene textured(std::vector<double> values, bool of_force = false) {
  scene::Scene scene = tests::table_1_closed_loop();
  scene.controller->target_friction_ratio.clear();
  scene.controller->texture = scene::Texture{period_m, std::move(values), of_force};
  scene.run.duration_s = 1.0;
  return scene;
}

/// Mean of 0.5 + 0.2 cos(k x − 0.4) + 0.05 cos(3 k x + 1) between two places.
double rendered_mean(double from_m, double to_m) {
  const double k = 2.0 * pi / period_m;
  const auto integral = [k](double x) {
    return 0.5 * x + 0.2 / k * std::sin(k * x - 0.4) +
           0.05 / (3.0 * k) * std::sin(3.0 * k * x + 1.0);
  };
  return (integral(to_m) - integral(from_m)) / (to_m - from_m);
}

/// Walks along the path at changing speeds, up to a place.
void walk(TextureMeter& meter, double& place_m, double to_m, double size) {
  double begin_s = 0.6;  // in the second half of the run
  int i = 0;
  while (place_m != to_m) {
    const double step_m = (to_m > place_m ? 1.0 : -1.0) * (3e-6 + 2e-6 * (i++ % 7));
    const double next_m = std::abs(to_m - place_m) <= std::abs(step_m) ? to_m : place_m + step_m;
    loop::Period period;
    period.begin_s = begin_s;
    period.begin_distance_m = place_m;
    period.end_distance_m = next_m;
    period.friction_ratio = rendered_mean(place_m, next_m);
    period.friction_force_N = period.friction_ratio * size;
    meter.take(period);
    place_m = next_m;
  }
}

/// @param backward  part of the passes
void expect_the_harmonics(const TextureMeter& meter, double backward = 0.0) {
  const std::vector<TextureHarmonic> found = meter.harmonics();
  const auto expected = [&](const TextureHarmonic& each, double amplitude, double phase) {
    const std::complex<double> forward = std::polar(amplitude, phase);
    const double mirrored = 2.0 * std::arg(each.wanted) - phase;
    return (1.0 - backward) * forward + backward * std::polar(amplitude, mirrored);
  };
  ASSERT_GE(found.size(), 4U);
  EXPECT_NEAR(found[0].rendered.real(), 0.5, 1e-5);  // of carrier periods at both ends of a pass
  for (const TextureHarmonic& each : found) {
    // A period of up to 15 um blurs harmonic h by a sixth of (h k 7.5 um)².
    if (each.harmonic == 1) {
      EXPECT_NEAR(std::abs(each.rendered - expected(each, 0.2, -0.4)), 0.0, 1e-3);
    } else if (each.harmonic == 3) {
      EXPECT_NEAR(std::abs(each.rendered - expected(each, 0.05, 1.0)), 0.0, 1e-3);
    } else if (each.harmonic != 0) {
      EXPECT_NEAR(std::abs(each.rendered), 0.0, 1e-3);
    }
  }
}

const std::vector<double> uneven{0.3, 0.7, 0.45, 0.5, 0.62, 0.41, 0.58, 0.35};

TEST(TextureMeter, ProjectsOverWholePeriodsInEitherDirection) {
  const scene::Scene scene = textured(uneven);
  for (const double to_m : {7.3e-3, -7.3e-3}) {
    TextureMeter meter(scene);
    double place_m = 0.2e-3;
    walk(meter, place_m, to_m, 1.0);
    EXPECT_EQ(meter.passes(), to_m > 0.0 ? 6U : 7U);
    expect_the_harmonics(meter, to_m > 0.0 ? 0.0 : 1.0);
  }
}

TEST(TextureMeter, LeavesOutAPeriodInWhichTheSlidingTurns) {
  const scene::Scene scene = textured(uneven);
  TextureMeter meter(scene);
  double place_m = 0.0;
  walk(meter, place_m, 3.4e-3, 1.0);  // 2 whole ones, the first is where it begins to count
  walk(meter, place_m, 1.7e-3, 1.0);  // 1 back, after the turn
  walk(meter, place_m, 5.2e-3, 1.0);  // 3
  EXPECT_EQ(meter.passes(), 2U + 1U + 3U);
  expect_the_harmonics(meter, 1.0 / 6.0);
}

TEST(TextureMeter, AForceIsOverTheFrictionLimit) {
  scene::Scene scene = textured(uneven, true);
  for (double& value : scene.controller->texture->values) {
    value *= scene.friction.limit_N();
  }
  TextureMeter meter(scene);
  double place_m = 0.0;
  walk(meter, place_m, 6.1e-3, scene.friction.limit_N());
  expect_the_harmonics(meter);
  EXPECT_NEAR(meter.harmonics()[0].wanted.real(), 0.48875, 1e-12);
}

TEST(TextureMeter, TellsNothingWithoutAWholePeriod) {
  const scene::Scene scene = textured(uneven);
  TextureMeter meter(scene);
  double place_m = 0.1e-3;
  walk(meter, place_m, 1.9e-3, 1.0);
  EXPECT_EQ(meter.passes(), 0U);
  EXPECT_TRUE(std::isnan(meter.harmonics()[1].rendered.real()));
}

TEST(TextureMeter, AHarmonicBelowAHundredthOfTheLargestIsFaint) {
  std::vector<double> values;
  for (int i = 0; i < 16; ++i) {
    const double turn = 2.0 * pi * i / 16;
    values.push_back(0.5 + 0.2 * std::sin(turn) + 0.004 * std::sin(2.0 * turn) +
                     0.001 * std::sin(3.0 * turn));
  }
  const scene::Scene scene = textured(values);
  const std::vector<TextureHarmonic> found = TextureMeter(scene).harmonics();
  ASSERT_EQ(found.size(), 4U);
  for (const TextureHarmonic& each : found) {
    EXPECT_EQ(each.is_faint, each.harmonic == 3) << each.harmonic;
  }
}

/// By a sum over a grid so fine that its own error is below the tolerance.
TEST(HarmonicOf, IsThatOfTheStraightLines) {
  const scene::Texture texture{period_m, uneven, false};
  constexpr int points = 200'000;
  for (const int harmonic : {0, 1, 2, 3, 4}) {
    std::complex<double> sum = 0.0;
    for (int i = 0; i < points; ++i) {
      const double turns = (i + 0.5) / points;
      sum += texture.at(turns * period_m) * std::polar(1.0, -2.0 * pi * harmonic * turns);
    }
    sum *= (harmonic == 0 ? 1.0 : 2.0) / points;
    EXPECT_NEAR(std::abs(harmonic_of(texture, harmonic) - sum), 0.0, 1e-8) << harmonic;
  }
}

}  // namespace
}  // namespace sonoglide::report::texture_metrics_test
