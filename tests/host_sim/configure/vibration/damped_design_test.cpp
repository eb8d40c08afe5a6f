#include "host_sim/configure/vibration/damped_design.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "firmware/control/vibration/mode_table.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::configure::damped_design_test {
namespace {

namespace mode = control::mode;

using tests::with_natural_frequency;

/// Larger part of the slope that a forecast has over the place, as control::ModeObserver has it.
double slope_of_forecast(const control::ModeInterpolation<double>& row, double real,
                         double imaginary, double change) {
  const auto rotated = [&](const auto& number, double* parts) {
    parts[0] = number(0) * real - number(1) * imaginary + number(2) * change;
    parts[1] = number(1) * real + number(0) * imaginary + number(3) * change;
  };
  double next[2];
  double slope[2];
  rotated([&](std::size_t i) { return row[mode::rotation + i]; }, next);
  rotated([&](std::size_t i) { return row.slope(mode::rotation + i); }, slope);
  double largest = 0.0;
  for (std::size_t part = 0; part < 2; ++part) {
    double tilt = row.slope(mode::forced + part) * change;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t output = mode::output + 2 * part + i;
      tilt += row.slope(output) * next[i] + row[output] * slope[i];
    }
    largest = std::max(largest, std::abs(tilt));
  }
  return largest;
}

TEST(DampedDesign, NoSlopeIsAudibleUpToTheQuietMode) {
  std::mt19937 random(20141);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (const double frequency : {0.21, 0.3, 0.63, 1.4, 2.35}) {
    const scene::Scene scene = with_natural_frequency(frequency);
    const NominalPlant plant = nominal_plant(scene);
    const DampedDesign design = design_damping(scene, plant, 4.0);
    ASSERT_GT(design.quiet, 0.0);
    double loudest = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      control::ModeInterpolation<double> row;
      row.go(design.table, part(random));
      const auto extreme = [&] { return std::copysign(design.quiet, part(random)); };
      loudest = std::max(loudest, slope_of_forecast(row, extreme(), extreme(), extreme()));
    }
    EXPECT_LE(loudest, design.audible) << frequency;
    EXPECT_GE(loudest, 0.2 * design.audible) << frequency << ": the bound is a loose one";
  }
}

}  // namespace
}  // namespace sonoglide::configure::damped_design_test
