/// The numbers by which a unit tells hosts its states, limits, faults and the like, and their words:
/// those of firmware/link/README.md.
#include "firmware/app/unit_names.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::unit_names_test {
namespace {

using Words = std::vector<std::pair<int, std::string>>;

template <class Code>
void expect_named(const Words& words) {
  for (const auto& [number, word] : words) {
    EXPECT_EQ(name(static_cast<Code>(number)), word) << number;
  }
}

TEST(UnitCodes, OfStatesAreThoseOfTheReference) {
  expect_named<control::State>({{0, "off"},
                                {1, "calibrating"},
                                {2, "running"},
                                {3, "limited"},
                                {4, "fault"},
                                {5, "relearning"}});
}

TEST(UnitCodes, OfLimitsAreThoseOfTheReference) {
  expect_named<control::Limit>({{0, "none"},
                                {1, "actuator"},
                                {2, "slew"},
                                {3, "speed_floor"},
                                {4, "ratio_end"},
                                {5, "mismatch"},
                                {6, "not_settling"},
                                {7, "bad_sample"},
                                {8, "voltage"},
                                {9, "current"},
                                {10, "frequency_range"},
                                {11, "velocity_at_rail"}});
}

TEST(UnitCodes, OfSettlingAreThoseOfTheReference) {
  expect_named<control::Settling>(
      {{0, "pending"}, {1, "settled"}, {2, "ringing"}, {3, "offset"}, {4, "clamped"}});
}

TEST(UnitCodes, OfParametersAreThoseOfTheReference) {
  expect_named<store::Origin>({{0, "stored"}, {1, "blank"}, {2, "other_design"}, {3, "damaged"}});
}

TEST(UnitCodes, OfFaultsAreThoseOfTheReference) {
  const Words faults = {{0, "none"},
                        {16, "measurement_not_finite"},
                        {17, "measurement_missing"},
                        {18, "measurement_saturated"},
                        {19, "measurement_stuck"},
                        {20, "friction_not_learnt"},
                        {21, "measurement_implausible"},
                        {22, "vibration_missing"},
                        {23, "vibration_saturated"},
                        {24, "resonance_lost"},
                        {25, "velocity_stuck"},
                        {32, "overrun"},
                        {33, "watchdog_reset"},
                        {34, "host_silent"},
                        {35, "parameters_lost"},
                        {36, "parameters_of_other_design"},
                        {37, "service_stalled"},
                        {38, "image_damaged"},
                        {65, "external_1"},
                        {74, "external_10"},
                        {95, "external_31"}};
  for (const auto& [number, word] : faults) {
    EXPECT_EQ(fault_name(static_cast<std::uint8_t>(number)), word) << number;
  }
  EXPECT_STREQ(fault_name(64), "none");  // below the first external one
  EXPECT_STREQ(fault_name(96), "none");  // above the last one
}

TEST(UnitCodes, OfTheParametersAreThoseOfTheReference) {
  const std::string names[] = {"target",      "drive_limit",   "gain_scale",     "friction_force",
                               "speed_floor", "stuck_periods", "start_on_power", "host_timeout",
                               "bad_samples", "force_offset",  "force_gain"};
  static_assert(std::size(names) == parameter_count);
  for (std::size_t i = 0; i < parameter_count; ++i) {
    EXPECT_EQ(parameter_labels[i].name, names[i]);
  }
  EXPECT_EQ(static_cast<int>(Parameter::target), 0);
  EXPECT_EQ(static_cast<int>(Parameter::drive_limit), 1);
  EXPECT_EQ(static_cast<int>(Parameter::gain_scale), 2);
  EXPECT_EQ(static_cast<int>(Parameter::friction_force), 3);
  EXPECT_EQ(static_cast<int>(Parameter::speed_floor), 4);
  EXPECT_EQ(static_cast<int>(Parameter::stuck_periods), 5);
  EXPECT_EQ(static_cast<int>(Parameter::start_on_power), 6);
  EXPECT_EQ(static_cast<int>(Parameter::host_timeout), 7);
  EXPECT_EQ(static_cast<int>(Parameter::bad_samples), 8);
  EXPECT_EQ(static_cast<int>(Parameter::force_offset), 9);
  EXPECT_EQ(static_cast<int>(Parameter::force_gain), 10);
}

}  // namespace
}  // namespace sonoglide::app::unit_names_test
