#include "firmware/control/feedback/contact_lead.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware/control/feedback/integral_regulator.hpp"
#include "scalars.hpp"

namespace sonoglide::control::contact_lead_test {
namespace {

constexpr double gain = 0.2;
constexpr int delay = 2;
constexpr double presliding_periods = 20.0;
constexpr double lead = gain * presliding_periods;

template <class Scalar>
numeric::Split<Scalar> doubled_lead() {
  const numeric::Split<double> parts = numeric::split(2.0 * lead);
  return {scaled<Scalar>(parts.mantissa), parts.exponent};
}

template <class Scalar>
class ContactLeadTest : public testing::Test {
 protected:
  using Integral = IntegralRegulator<Scalar, delay>;
  using Led = ContactLead<Integral>;

  /// The reference expects an error that decays by the gain.
  static typename Integral::Parameters integral() {
    typename Integral::Parameters all{};
    all.gain = scaled<Scalar>(gain);
    all.keep = scaled<Scalar>(1.0 / (1.0 + gain));
    all.hold_periods = static_cast<std::uint16_t>(delay + 4.0 / gain);
    all.rest_periods = all.hold_periods;
    all.delay_periods = delay;
    return all;
  }
  static typename Led::Parameters led() { return {integral(), doubled_lead<Scalar>()}; }
};
TYPED_TEST_SUITE(ContactLeadTest, Scalars);

TYPED_TEST(ContactLeadTest, AddsItsPartOfTheErrorWithinTheRangeOfACommand) {
  ContactLead<NoFeedback<TypeParam>> regulator({{}, doubled_lead<TypeParam>()});
  constexpr double lost = 2e-3;  // eight times two units of the last place of Q15, and its inputs'
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> part(0.0, 0.5);
  for (int i = 0; i < 2000; ++i) {
    const double target = part(generator);
    const double measured = part(generator);
    const TypeParam ratio =
        regulator.propose(scaled<TypeParam>(target), scaled<TypeParam>(measured));
    const double expected =
        std::clamp(target + lead * 2.0 * target * (target - measured), 0.0, 0.5);
    ASSERT_NEAR(numeric::to_real(ratio), expected, lost) << target << " " << measured;
    ASSERT_TRUE(!(ratio < TypeParam{}) && !(scaled<TypeParam>(0.5) < ratio));
  }
}

/// A regulator with a lead of 0 beside one without, in the same loop.
template <class Scalar, class Regulator>
void expect_the_same(const typename Regulator::Parameters& parameters) {
  ContactLead<Regulator> open({parameters, {}});
  Regulator alone(parameters);
  std::mt19937 generator(35);
  std::uniform_real_distribution<double> part(-0.1, 0.1);
  double asked = 0.25;
  double commanded = asked;
  open.restart(scaled<Scalar>(asked));
  alone.restart(scaled<Scalar>(asked));
  for (int i = 0; i < 3000; ++i) {
    if (i % 50 == 49) {
      const double next = 0.25 + part(generator);
      open.target_changes(scaled<Scalar>(next - asked));
      alone.target_changes(scaled<Scalar>(next - asked));
      asked = next;
    }
    const auto measured = scaled<Scalar>(std::clamp(commanded + part(generator), 0.0, 0.5));
    const Scalar ratio = open.propose(scaled<Scalar>(asked), measured);
    ASSERT_EQ(ratio, alone.propose(scaled<Scalar>(asked), measured)) << i;
    commanded = numeric::to_real(ratio);
    open.accept(i % 7 == 0, i % 11 == 0);
    alone.accept(i % 7 == 0, i % 11 == 0);
  }
}

TYPED_TEST(ContactLeadTest, IsTheRegulatorWithoutALead) {
  using Own = ContactLeadTest<TypeParam>;
  expect_the_same<TypeParam, NoFeedback<TypeParam>>({});
  expect_the_same<TypeParam, typename Own::Integral>(Own::integral());
}

TYPED_TEST(ContactLeadTest, IsScaledWithTheGain) {
  using Own = ContactLeadTest<TypeParam>;
  auto parameters = Own::led();
  Own::Led::scale_gain(parameters, scaled<TypeParam>(0.5));
  EXPECT_NEAR(numeric::to_real(parameters.lead.mantissa),
              0.5 * numeric::to_real(Own::led().lead.mantissa), 1e-4);
  EXPECT_EQ(parameters.lead.exponent, Own::led().lead.exponent);
  EXPECT_NEAR(numeric::to_real(parameters.regulator.gain), 0.5 * gain, 1e-4);
}

/// Periods until the ratio of a Dahl contact is within 0.02 of its target for good; whole ratios.
/// @param stiffness  of the contact, over that of the lead
/// @param map        what the inverse map has wrong of a ratio
template <class Scalar, class Regulator>
int settling_periods(Regulator regulator, double from, double to, double stiffness, double map) {
  regulator.restart(scaled<Scalar>(0.5 * from));
  regulator.target_changes(scaled<Scalar>(0.5 * (to - from)));
  std::vector<double> commands(delay, from);
  double ratio = from;
  int settled = 0;
  constexpr int periods = 400;
  for (int i = 0; i < periods; ++i) {
    const double rest = std::clamp(commands[commands.size() - delay] + map, 0.05, 1.0);
    ratio = rest + (ratio - rest) * std::exp(-stiffness / (rest * presliding_periods));
    settled = std::abs(ratio - to) < 0.02 ? settled : i + 1;
    commands.push_back(2.0 * numeric::to_real(regulator.propose(scaled<Scalar>(0.5 * to),
                                                                scaled<Scalar>(0.5 * ratio))));
    regulator.accept(false, false);
  }
  return settled;
}

struct Step {
  double from;
  double to;
};
constexpr Step steps[] = {{0.9, 0.4}, {0.6, 0.3}, {0.3, 0.8}};

TYPED_TEST(ContactLeadTest, BringsASlowContactToItsTargetInLessThanTwoThirdsOfTheTime) {
  using Own = ContactLeadTest<TypeParam>;
  for (const auto& [from, to] : steps) {
    const double alone = to * presliding_periods * std::log(std::abs(to - from) / 0.02);
    const int led = settling_periods<TypeParam>(typename Own::Led(Own::led()), from, to, 1.0, 0.0);
    EXPECT_LT(led, 0.65 * alone) << from << " to " << to;
  }
}

TYPED_TEST(ContactLeadTest, SettlesSoonerThanTheIntegralAloneWithAWrongContactAndMap) {
  using Own = ContactLeadTest<TypeParam>;
  for (const auto& [from, to] : steps) {
    for (const double stiffness : {2.0 / 3.0, 0.8, 1.0, 1.25, 2.0}) {
      for (const double map : {-0.04, 0.0, 0.04}) {
        const int led =
            settling_periods<TypeParam>(typename Own::Led(Own::led()), from, to, stiffness, map);
        const int alone = settling_periods<TypeParam>(typename Own::Integral(Own::integral()), from,
                                                      to, stiffness, map);
        EXPECT_LT(led, 0.85 * alone) << from << " to " << to << ", " << stiffness << ' ' << map;
      }
    }
  }
}

}  // namespace
}  // namespace sonoglide::control::contact_lead_test
