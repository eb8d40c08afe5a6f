#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/control/friction/coulomb_feedforward.hpp"
#include "firmware/control/friction/dahl_feedforward.hpp"
#include "firmware/control/friction/tabulated_feedforward.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "scalars.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/constants/table_1_numbers.hpp"

namespace sonoglide::control::feedforward_test {
namespace {

template <class Scalar>
class FeedforwardTest : public testing::Test {
 protected:
  static DahlFeedforward<Scalar> dahl(double contact_force, double friction_force) {
    const numeric::Split<double> force = numeric::split(contact_force);
    const typename DahlFeedforward<Scalar>::Parameters parameters{
        {scaled<Scalar>(force.mantissa), force.exponent}};
    DahlFeedforward<Scalar> feedforward(parameters);
    feedforward.set_friction(FrictionLevel<Scalar>(scaled<Scalar>(friction_force)));
    return feedforward;
  }
};
TYPED_TEST_SUITE(FeedforwardTest, Scalars);

TYPED_TEST(FeedforwardTest, CoulombFollowsTheSineAtAnySpeed) {
  const CoulombFeedforward<TypeParam> feedforward({});
  const double largest = numeric::to_real(numeric::from_code<TypeParam>(INT32_MAX));
  for (double half_ratio = 0.0; half_ratio < 0.5; half_ratio += 0.013) {
    for (const double speed : {0.001, 0.1, 0.99}) {
      const double amplitude = numeric::to_real(
          feedforward.amplitude(scaled<TypeParam>(half_ratio), scaled<TypeParam>(speed)));
      const double r = std::sin(tests::pi * half_ratio);
      const double wanted = speed < r ? speed / r : largest;
      EXPECT_NEAR(amplitude, wanted, 8.0 * resolution<TypeParam>() / std::max(r, speed));
    }
  }
}

// At the amplitude that the feedforward asks for, the closed-form map gives the ratio back; where it
// asks for all there is, full drive leaves no less. The map is held to Dahl numbers from 0.01 to
// 1000.
TYPED_TEST(FeedforwardTest, DahlMeetsTheClosedFormMap) {
  int met = 0;
  int beyond_the_drive = 0;
  for (const double contact_force : {0.05, 1.0108, 20.0}) {
    for (const double friction_force : {0.01, 0.3, 0.5, 0.9}) {
      const auto feedforward = this->dahl(contact_force, friction_force);
      for (const double speed : {0.02, 0.1, 0.6, 0.99}) {
        for (const double ratio : {0.05, 0.2, 0.4, 0.7, 0.95}) {
          const double amplitude = numeric::to_real(
              feedforward.amplitude(scaled<TypeParam>(0.5 * ratio), scaled<TypeParam>(speed)));
          if (amplitude > 0.999999) {
            const double dahl_number = contact_force / friction_force;
            EXPECT_GE(friction::dahl_friction_ratio(speed, dahl_number), ratio - 0.002)
                << "Kt X " << contact_force << " Fc " << friction_force << " speed " << speed;
            ++beyond_the_drive;
            continue;
          }
          const double r = speed / amplitude;
          const double dahl_number = contact_force / friction_force * speed / r;
          if (dahl_number < 0.01 || dahl_number > 1000.0) {
            continue;
          }
          EXPECT_NEAR(friction::dahl_friction_ratio(r, dahl_number), ratio, 0.002)
              << "Kt X " << contact_force << " Fc " << friction_force << " speed " << speed;
          ++met;
        }
      }
    }
  }
  EXPECT_EQ(met, 117);
  EXPECT_EQ(beyond_the_drive, 110);
}

// Table 1 at 26.72 mm/s: forces worked out apart from this program, to 1 %.
TYPED_TEST(FeedforwardTest, DahlAsksForTheKnownForcesAtTable1) {
  using tests::Table1;
  constexpr double amplitude_m = 1920.0 * Table1::compliance_m_per_N;
  constexpr double speed = 26.72e-3 / (amplitude_m * Table1::carrier_rad_per_s);
  constexpr double full_scale_N = 2.0 * Table1::friction_limit_N;
  const auto feedforward =
      this->dahl(Table1::contact_stiffness_N_per_m * amplitude_m / full_scale_N, 0.5);
  const double known[][2] = {{0.3, 818.6}, {0.5, 526.3}, {0.7, 367.9}};
  for (const auto& [ratio, force_N] : known) {
    const double amplitude = numeric::to_real(
        feedforward.amplitude(scaled<TypeParam>(0.5 * ratio), scaled<TypeParam>(speed)));
    EXPECT_NEAR(amplitude * 1920.0, force_N, 0.01 * force_N);
  }
}

template <class Scalar>
typename TabulatedFeedforward<Scalar>::Parameters tabulated(friction::InverseForm form,
                                                            bool over_force, double reach) {
  const auto split = [](double value) {
    const numeric::Split<double> parts = numeric::split(value);
    return numeric::Split<Scalar>{scaled<Scalar>(parts.mantissa), parts.exponent};
  };
  return {split(2.0), split(reach), over_force, form, {}};
}

// A table of one z: what is left is the form.
TYPED_TEST(FeedforwardTest, ATableGivesTheVelocityOfItsForm) {
  constexpr double reach = 3.7;
  constexpr double z = 0.5;
  struct Form {
    friction::InverseForm form;
    double (*velocity)(double ratio, double speed);
  };
  const Form forms[] = {
      {friction::InverseForm::beyond_sliding,
       [](double ratio, double v) { return v + reach * v / ratio * z * z; }},
      {friction::InverseForm::over_ratio,
       [](double ratio, double v) { return reach * v / ratio * z * z; }},
      {friction::InverseForm::plain, [](double /*ratio*/, double v) { return reach * v * z * z; }}};
  for (const Form& form : forms) {
    auto parameters = tabulated<TypeParam>(form.form, false, reach);
    for (auto& row : parameters.table) {
      row.fill(1 << 14);
    }
    const TabulatedFeedforward<TypeParam> feedforward(parameters);
    for (const double ratio : {0.05, 0.3, 0.7, 0.99}) {
      for (const double speed : {0.01, 0.05, 0.3}) {
        const double amplitude = numeric::to_real(
            feedforward.amplitude(scaled<TypeParam>(0.5 * ratio), scaled<TypeParam>(speed)));
        const double wanted = std::min(form.velocity(ratio, speed), 1.0);
        EXPECT_NEAR(std::min(amplitude, 1.0), wanted, 1e-6) << ratio << ' ' << speed;
      }
    }
    const double at_none =
        numeric::to_real(feedforward.amplitude(TypeParam{}, scaled<TypeParam>(0.1)));
    EXPECT_NEAR(at_none, form.form == friction::InverseForm::plain ? 0.1 * reach * z * z : 1.0,
                1e-6);
  }
}

// A row for each reduced travel: of the speed, or of the speed over the friction level that is learnt.
TYPED_TEST(FeedforwardTest, ATableIsReadWhereTheFrictionLevelSays) {
  auto parameters = tabulated<TypeParam>(friction::InverseForm::plain, true, 1.0);
  for (std::size_t row = 0; row < parameters.table.size(); ++row) {
    parameters.table[row].fill(static_cast<std::uint16_t>(256 * row));
  }
  const auto amplitude = [&](bool over_force, double level) {
    parameters.over_force = over_force;
    TabulatedFeedforward<TypeParam> feedforward(parameters);
    feedforward.set_friction(FrictionLevel<TypeParam>(scaled<TypeParam>(level)));
    return numeric::to_real(
        feedforward.amplitude(scaled<TypeParam>(0.25), scaled<TypeParam>(0.25)));
  };
  // At a ratio of 1/2 and a speed of 1/4 the reduced travel is 1 over the level: row 1 + 4 * 4 is 1.
  const auto of_row = [](int row) { return 0.25 * std::pow(row / 128.0, 2); };
  EXPECT_NEAR(amplitude(true, 0.5), of_row(21), 1e-6);
  EXPECT_NEAR(amplitude(true, 0.25), of_row(25), 1e-6);
  EXPECT_NEAR(amplitude(false, 0.5), of_row(17), 1e-6);
  EXPECT_NEAR(amplitude(false, 0.25), of_row(17), 1e-6);
}

TYPED_TEST(FeedforwardTest, ACopyReadsTheTableThatItSettlesAt) {
  auto designed = tabulated<TypeParam>(friction::InverseForm::plain, false, 1.0);
  designed.table[17].fill(1 << 14);
  designed.table[18].fill(1 << 14);
  auto elsewhere = designed;
  TabulatedFeedforward<TypeParam> feedforward(elsewhere);
  feedforward.settle_at(designed);
  elsewhere.table = {};
  const double amplitude =
      numeric::to_real(feedforward.amplitude(scaled<TypeParam>(0.25), scaled<TypeParam>(0.25)));
  EXPECT_NEAR(amplitude, 0.25 * 0.25, 1e-6);
}

TYPED_TEST(FeedforwardTest, BothGiveTheEndsOfTheMap) {
  const CoulombFeedforward<TypeParam> coulomb({});
  const auto dahl = this->dahl(1.0108, 0.5);
  const auto speed = scaled<TypeParam>(0.1);
  const auto largest = numeric::from_code<TypeParam>(INT32_MAX);
  EXPECT_EQ(coulomb.amplitude(TypeParam{}, speed), largest);
  EXPECT_EQ(dahl.amplitude(TypeParam{}, speed), largest);
  const auto whole = scaled<TypeParam>(0.5);
  EXPECT_NEAR(numeric::to_real(coulomb.amplitude(whole, speed)), 0.1, 1e-7);
  EXPECT_NEAR(numeric::to_real(dahl.amplitude(whole, speed)), 0.1, 1e-7);
}

}  // namespace
}  // namespace sonoglide::control::feedforward_test
