#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "firmware/friction/dahl_friction_ratio.hpp"
#include "host_sim/batch/dahl_friction_ratios.hpp"
#include "tests/host_sim/batch/runs/instruction_sets.hpp"

namespace sonoglide::batch {
namespace {

double unit() {
  return *rc::gen::inRange(0, 1 << 30) * 0x1p-30;
}

/// Anywhere, or close to one of the ends of [0, 1].
double velocity_ratio() {
  const double tiny = std::pow(10.0, -15.0 * unit());
  switch (*rc::gen::inRange(0, 3)) {
    case 0:
      return 1.0 - tiny;
    case 1:
      return tiny;
    default:
      return 1.5 * unit();
  }
}

TEST(FrictionRatios, AgreeWithTheScalarMap) {
  EXPECT_TRUE(rc::check([] {
    const auto count = static_cast<std::size_t>(*rc::gen::inRange(0, 40));
    std::vector<double> velocity_ratios(count);
    std::vector<double> dahl_numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
      velocity_ratios[i] = velocity_ratio() * (*rc::gen::arbitrary<bool>() ? 1.0 : -1.0);
      dahl_numbers[i] = 1e-4 * std::pow(10.0, 11.0 * unit());
    }
    const std::vector<double> ratios = dahl_friction_ratios(velocity_ratios, dahl_numbers);
    RC_ASSERT(ratios.size() == count);
    for (std::size_t i = 0; i < count; ++i) {
      const double expected = friction::dahl_friction_ratio(velocity_ratios[i], dahl_numbers[i]);
      RC_ASSERT(std::abs(ratios[i] - expected) <= 1e-12);
    }
  }));
}

TEST(FrictionRatios, AgreeOnEveryInstructionSet) {
  std::vector<double> velocity_ratios;
  std::vector<double> dahl_numbers;
  for (int i = 0; i <= 60; ++i) {
    for (int j = 0; j <= 44; ++j) {
      velocity_ratios.push_back(0.025 * i);
      dahl_numbers.push_back(1e-4 * std::pow(10.0, 0.25 * j));
    }
  }
  on_each_instruction_set([&](const char* name) {
    const std::vector<double> ratios = dahl_friction_ratios(velocity_ratios, dahl_numbers);
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      ASSERT_NEAR(ratios[i], friction::dahl_friction_ratio(velocity_ratios[i], dahl_numbers[i]),
                  1e-12)
          << name << ' ' << velocity_ratios[i] << ' ' << dahl_numbers[i];
    }
  });
}

TEST(FrictionRatios, APointAloneHasTheSameBits) {
  std::vector<double> velocity_ratios;
  std::vector<double> dahl_numbers;
  for (int i = 0; i < 37; ++i) {
    velocity_ratios.push_back(0.03 * i);
    dahl_numbers.push_back(1e-3 * std::pow(1.7, i));
  }
  const std::vector<double> ratios = dahl_friction_ratios(velocity_ratios, dahl_numbers);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    EXPECT_EQ(dahl_friction_ratios({velocity_ratios[i]}, {dahl_numbers[i]})[0], ratios[i]);
  }
}

TEST(FrictionRatios, WhatDoesNotReverseSlidesFully) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(dahl_friction_ratios({1.0, -1.0, 7.0, nan}, {1e-4, 1.0, 1e7, 1.0}),
            std::vector<double>(4, 1.0));
}

}  // namespace
}  // namespace sonoglide::batch
