#include "firmware/app/field_parameters.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/friction/coulomb_feedforward.hpp"
#include "firmware/control/friction/dahl_feedforward.hpp"
#include "firmware/control/friction/learnt_friction.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "firmware/control/limits/slew_limit.hpp"
#include "firmware/numeric/fixed.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::field_parameters_test {
namespace {

template <class S>
class FieldParametersTest : public testing::Test {
 protected:
  using Parts = control::Parts<S, control::TrustedFriction<S>, control::CoulombFeedforward<S>,
                               control::NoSlewLimit<S>, control::NoShaping<S>,
                               control::IntegralRegulator<S, 1>>;
  using Designed = typename control::Controller<Parts>::Parameters;
  using Design = FieldDesign<Parts>;

  static constexpr S real(double value) { return numeric::from_real<S>(value); }
  /// Numbers that no millionth equals.
  static constexpr Designed designed = {real(1.0 / 3.0),
                                        real(1.0 / 700.0),
                                        real(0.01 / 7.0),
                                        real(0.1),
                                        {},
                                        {},
                                        {},
                                        {},
                                        {real(1.0 / 9.0), real(0.0), 3, 12, 1},
                                        {},
                                        {},
                                        {500, real(1.0 / 128.0)},
                                        {10},
                                        {20},
                                        {real(1.0 / 90.0), 60, real(0.7)},
                                        {},
                                        {}};
  static constexpr double period_s = 1.0 / 60e3;
  static constexpr Design design{designed,    real(1.0 / 6.0), 1,
                                 full_scales, period_s,        default_timeout_ms};

  static ParameterValues with(Parameter parameter, std::uint32_t value) {
    ParameterValues values = design.presets();
    values[static_cast<std::size_t>(parameter)] = value;
    return values;
  }
};
using Arithmetics =
    testing::Types<float, numeric::Q31<numeric::Saturating>, numeric::Q31<numeric::Trapping>>;
TYPED_TEST_SUITE(FieldParametersTest, Arithmetics);

TYPED_TEST(FieldParametersTest, UnchangedItIsTheDesignBitForBit) {
  const auto& tested = TestFixture::design;
  const auto parameters = tested.controller_parameters(tested.presets());
  EXPECT_TRUE(parameters.friction_force == TestFixture::designed.friction_force);
  EXPECT_TRUE(parameters.speed_floor == TestFixture::designed.speed_floor);
  EXPECT_TRUE(parameters.lead == TestFixture::designed.lead);
  EXPECT_TRUE(parameters.regulator.gain == TestFixture::designed.regulator.gain);
  EXPECT_EQ(parameters.regulator.hold_periods, TestFixture::designed.regulator.hold_periods);
  EXPECT_EQ(parameters.stuck.periods, TestFixture::designed.stuck.periods);
  EXPECT_TRUE(parameters.ceiling.highest == control::FullDrive<TypeParam>::highest());
  EXPECT_TRUE(tested.target(333333) == this->real(1.0 / 6.0));
}

TYPED_TEST(FieldParametersTest, EachParameterGoesWhereItSays) {
  const auto half = this->real(0.5);
  const auto parameters = [](Parameter parameter, std::uint32_t value) {
    return TestFixture::design.controller_parameters(TestFixture::with(parameter, value));
  };
  EXPECT_TRUE(parameters(Parameter::drive_limit, 500000).ceiling.highest == half);
  EXPECT_TRUE(parameters(Parameter::friction_force, 500000).friction_force == half);
  EXPECT_TRUE(parameters(Parameter::speed_floor, 500000).speed_floor == half);
  EXPECT_NEAR(numeric::to_real(parameters(Parameter::gain_scale, 500000).regulator.gain),
              1.0 / 18.0, 1e-8);
  EXPECT_TRUE(parameters(Parameter::gain_scale, 0).regulator.gain == TypeParam{});
  EXPECT_EQ(parameters(Parameter::stuck_periods, 65535).stuck.periods, 65535);
  EXPECT_TRUE(TestFixture::design.target(500000) == this->real(0.25));
  EXPECT_TRUE(TestFixture::design.target(1000000) == half);
}

/// A force is a part of its sensor's full scale, the designed one exactly.
TYPED_TEST(FieldParametersTest, ATargetThatIsAForceHasTheFullScaleAsItsBase) {
  using S = TypeParam;
  using HoldingParts =
      control::Parts<S, control::TrustedFriction<S>, control::CoulombFeedforward<S>,
                     control::NoSlewLimit<S>, control::NoShaping<S>,
                     control::IntegralRegulator<S, 1>, control::NoRelearning<S>,
                     control::FedForward<S>, control::ForceSensor, control::ForceTarget<S>>;
  typename control::Controller<HoldingParts>::Parameters holding{};
  holding.friction_force = this->real(0.5);
  holding.target = {true};
  const FieldDesign<HoldingParts> tested(holding, this->real(1.0 / 7.0), 1, full_scales,
                                         TestFixture::period_s, default_timeout_ms);
  const ParameterValues presets = tested.presets();
  EXPECT_EQ(presets[static_cast<std::size_t>(Parameter::target)], 142857U);
  EXPECT_TRUE(tested.target(142857) == this->real(1.0 / 7.0));
  EXPECT_TRUE(tested.target(500000) == this->real(0.5));
  EXPECT_TRUE(tested.target(0) == S{});
  EXPECT_TRUE(tested.target(1000000) == control::FullDrive<S>::highest());
  EXPECT_TRUE(tested.controller_parameters(presets).target.force);
}

// Every millionth, as if it had been written in a scene.
TYPED_TEST(FieldParametersTest, MillionthsAreRoundedOnce) {
  for (std::uint32_t i = 0; i < one_in_millionths; ++i) {
    ASSERT_TRUE(fraction<TypeParam>(i, one_in_millionths) == this->real(i / 1e6)) << i;
    ASSERT_TRUE(fraction<TypeParam>(i, 2 * one_in_millionths) == this->real(i / 2e6)) << i;
  }
  EXPECT_TRUE(fraction<TypeParam>(1, 1) == control::FullDrive<TypeParam>::highest());
}

/// Of the largest code that count / 10^6 allows, as far below as the scalar's last digit.
template <class S>
void expect_rounded_down(std::uint32_t count) {
  const auto highest = static_cast<std::int32_t>((std::uint64_t{count} << 31) / one_in_millionths);
  const S value = fraction_below<S>(count, one_in_millionths);
  const std::int32_t code = numeric::to_code(value);
  ASSERT_LE(code, highest) << count;
  ASSERT_EQ(numeric::to_real(value) * 0x1p31, code) << count;
  if constexpr (numeric::is_fixed_point_v<S>) {
    ASSERT_LT(highest - code, 1 << (31 - S::fraction_bits)) << count;
  } else {
    ASSERT_LE(highest - code, std::ldexp(highest, 1 - std::numeric_limits<S>::digits)) << count;
  }
}

// A limit that is a hair above what was allowed is no limit.
TEST(DriveLimit, IsRoundedDownInEveryArithmetic) {
  for (std::uint32_t i = 0; i < one_in_millionths; ++i) {
    expect_rounded_down<float>(i);
    expect_rounded_down<double>(i);
    expect_rounded_down<numeric::Q31<numeric::Saturating>>(i);
    expect_rounded_down<numeric::Q15<numeric::Saturating>>(i);
  }
}

TYPED_TEST(FieldParametersTest, TheDriveLimitIsRoundedDown) {
  for (std::uint32_t i = 0; i < one_in_millionths; i += 997) {
    const auto values = TestFixture::with(Parameter::drive_limit, i);
    const auto highest = TestFixture::design.controller_parameters(values).ceiling.highest;
    ASSERT_TRUE(highest == fraction_below<TypeParam>(i, one_in_millionths)) << i;
  }
}

// Stores in the field hold these: another number, and a parameter or the whole store is not found.
TEST(ParameterIdentity, StaysWhatItWas) {
  const std::uint32_t identities[parameter_count] = {0x65EDB271, 0x13371804, 0x642F8C86, 0xF9CE71CD,
                                                     0x89D3878E, 0x053AC4F5, 0xC774790D, 0x57351E83,
                                                     0x09F1B95E, 0x2DC4B29B, 0xD6C95F15};
  for (std::size_t i = 0; i < parameter_count; ++i) {
    EXPECT_EQ(parameter_identities[i], identities[i]) << parameter_labels[i].name;
  }
  EXPECT_EQ(field_design.design(), 0xD3C23505U);
}

TYPED_TEST(FieldParametersTest, PresetsAndTheEndsOfRangesAreAllowed) {
  const auto& tested = TestFixture::design;
  EXPECT_TRUE(tested.allows(tested.presets()));
  int lower_ends = 0;
  for (std::size_t i = 0; i < parameter_count; ++i) {
    const ParameterRange& range = tested.range(i);
    const char* const name = parameter_labels[i].name;
    EXPECT_TRUE(range.allows(range.preset)) << name;
    const auto parameter = static_cast<Parameter>(i);
    EXPECT_TRUE(tested.allows(this->with(parameter, range.lowest))) << name;
    EXPECT_TRUE(tested.allows(this->with(parameter, range.highest))) << name;
    EXPECT_FALSE(tested.allows(this->with(parameter, range.highest + 1))) << name;
    if (range.lowest > 0) {  // of a signed one it is below 0
      EXPECT_FALSE(tested.allows(this->with(parameter, range.lowest - 1))) << name;
      ++lower_ends;
    }
  }
  EXPECT_GE(lower_ends, 1);
  // No allowed friction force is too small for the controller.
  const auto smallest =
      tested.controller_parameters(this->with(Parameter::friction_force, tested.range(3).lowest));
  EXPECT_FALSE(smallest.friction_force < control::FrictionLevel<TypeParam>::smallest());
}

TYPED_TEST(FieldParametersTest, AnotherDesignHasAnotherNumber) {
  using Other = typename TestFixture::Design;
  auto other = TestFixture::designed;
  other.speed_floor = this->real(0.02);
  const auto target = this->real(1.0 / 6.0);
  const std::set<std::uint32_t> numbers{
      TestFixture::design.design(),
      Other(TestFixture::designed, target, 2, full_scales, TestFixture::period_s,
            default_timeout_ms)
          .design(),
      Other(TestFixture::designed, this->real(0.2), 1, full_scales, TestFixture::period_s,
            default_timeout_ms)
          .design(),
      Other(TestFixture::designed, target, 1, full_scales, TestFixture::period_s, 0).design(),
      Other(other, target, 1, full_scales, TestFixture::period_s, default_timeout_ms).design()};
  EXPECT_EQ(numbers.size(), 5U);
}

TEST(ParameterIdentity, IsOfNameUnitAndPlaces) {
  std::set<std::uint32_t> identities;
  for (std::size_t i = 0; i < parameter_count; ++i) {
    EXPECT_EQ(parameter_identities[i], parameter_labels[i].identity());
    identities.insert(parameter_identities[i]);
  }
  EXPECT_EQ(identities.size(), parameter_count);
  ParameterLabel label = parameter_labels[0];
  label.decimal_places = 3;
  identities.insert(label.identity());
  label.unit = " s";
  identities.insert(label.identity());
  label.name = "target ";
  label.unit = "s";
  identities.insert(label.identity());
  EXPECT_EQ(identities.size(), parameter_count + 3);
  // CRC-32 of "drive_limit", 0, 0, 6: the store's format.
  EXPECT_EQ(parameter_identities[1], 0x13371804U);
}

TYPED_TEST(FieldParametersTest, OfAnotherDesignOnlyLimitsAreInherited) {
  const auto& tested = TestFixture::design;
  const auto inherited = [&](Parameter parameter, std::uint32_t stored) {
    return tested.range(static_cast<std::size_t>(parameter)).inherited(stored);
  };
  EXPECT_EQ(inherited(Parameter::drive_limit, 200000), 200000U);
  EXPECT_EQ(inherited(Parameter::drive_limit, UINT32_MAX), 1000000U);
  EXPECT_EQ(inherited(Parameter::gain_scale, 0), 0U);
  EXPECT_EQ(inherited(Parameter::start_on_power, 1), 1U);
  EXPECT_EQ(inherited(Parameter::host_timeout, 0), 0U);
  EXPECT_EQ(inherited(Parameter::host_timeout, 99999), 60000U);
  EXPECT_EQ(inherited(Parameter::speed_floor, 1000), 1429U);  // the design's, which is higher
  EXPECT_EQ(inherited(Parameter::speed_floor, 5000), 5000U);
  EXPECT_EQ(inherited(Parameter::target, 700000), 333333U);
  EXPECT_EQ(inherited(Parameter::friction_force, 700000), 333333U);
  EXPECT_EQ(inherited(Parameter::stuck_periods, 1000), 10U);
}

TYPED_TEST(FieldParametersTest, TheTimeoutIsCountedInCarrierPeriods) {
  using Other = typename TestFixture::Design;
  const auto periods = [](double period, std::uint32_t timeout_ms) {
    const Other other(TestFixture::designed, TestFixture::real(1.0 / 6.0), 1, full_scales, period,
                      default_timeout_ms);
    return other.timeout_periods(TestFixture::with(Parameter::host_timeout, timeout_ms));
  };
  EXPECT_EQ(periods(1.0 / 60e3, 0), 0U);
  EXPECT_EQ(periods(1.0 / 60e3, 1), 60U);
  EXPECT_EQ(periods(1.0 / 60e3, 100), 6000U);
  EXPECT_EQ(periods(1.0 / 60e3, 60000), 3600000U);
  EXPECT_EQ(periods(16.0 / 60e3, 1), 4U);  // 3.75
  EXPECT_EQ(periods(0.02, 1), 1U);
  EXPECT_EQ(periods(1e-6, 60000), 60000000U);
}

template <class S>
void expect_drive_within_its_limit() {
  using Parts = control::Parts<S, control::TrustedFriction<S>, control::DahlFeedforward<S>,
                               control::NoSlewLimit<S>, control::NoShaping<S>,
                               control::IntegralRegulator<S, 1>>;
  static constexpr numeric::Split<double> force = numeric::split(1.0108);
  static constexpr typename control::Controller<Parts>::Parameters designed{
      numeric::from_real<S>(0.5),
      numeric::from_real<S>(1.0 / 1024.0),
      numeric::from_real<S>(0.026),
      numeric::from_real<S>(0.02),
      {},
      {{numeric::from_real<S>(force.mantissa), force.exponent}},
      {},
      {},
      {numeric::from_real<S>(0.148), numeric::from_real<S>(0.0), 5, 20, 1},
      {},
      {},
      {5000, numeric::from_real<S>(1.0 / 128.0)},
      {11},
      {21},
      {numeric::from_real<S>(0.005), 60, numeric::from_real<S>(0.8)},
      {},
      {}};
  static constexpr FieldDesign<Parts> design(designed, numeric::from_real<S>(0.2), 1, full_scales,
                                             1.0 / 60e3, default_timeout_ms);

  ParameterValues values{};
  for (std::size_t i = 0; i < parameter_count; ++i) {
    const ParameterRange& range = design.range(i);
    values[i] = *rc::gen::oneOf(rc::gen::just(range.lowest), rc::gen::just(range.highest),
                                rc::gen::inRange(range.lowest, range.highest));
  }
  const auto parameters = design.controller_parameters(values);
  typename FieldDesign<Parts>::Controller controller(parameters);
  controller.set_target(design.target(values[0]));
  controller.start();
  const auto code = rc::gen::arbitrary<std::int32_t>();
  for (int i = 0; i < 50; ++i) {
    const auto command =
        controller.step({numeric::from_code<S>(*code), numeric::from_code<S>(*code >> (i % 12)),
                         control::Quality::good});
    RC_ASSERT(S{} <= command.amplitude);
    RC_ASSERT(command.amplitude <= parameters.ceiling.highest);
    RC_ASSERT(command.state != control::State::fault ||
              command.fault == control::Fault::measurement_stuck);
  }
}

RC_GTEST_PROP(FieldValues, AnyThatAreAllowedKeepTheDriveWithinItsLimit, ()) {
  expect_drive_within_its_limit<float>();
  expect_drive_within_its_limit<numeric::Q31<numeric::Saturating>>();
}

}  // namespace
}  // namespace sonoglide::app::field_parameters_test
