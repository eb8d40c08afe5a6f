#include "host_sim/configure/vibration/notch_design.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "tests/common/constants/pi.hpp"

namespace sonoglide::configure::notch_design_test {
namespace {

using tests::pi;

const double table_1_rotation = std::sqrt(133e6 / 0.02) / 60e3;

/// The tap counts and spacings of a step's answer, a jump of the drive at each.
struct Jump {
  double period;
  double size;
};

std::vector<Jump> jumps_of(const NotchDesign& notch) {
  std::vector<Jump> jumps;
  for (std::size_t i = 0; i < notch.tap_count; ++i) {
    jumps.push_back({static_cast<double>(i * notch.spacing), notch.taps[i]});
  }
  return jumps;
}

/// The free motion that jumps of the drive leave behind at the last one, of that of a single jump:
/// the mode turns and decays from each jump to the next.
double left_of_a_step(const std::vector<Jump>& jumps, double decay, double rotation) {
  std::complex<double> motion = 0.0;
  double before = 0.0;
  for (const Jump& jump : jumps) {
    const double wait = jump.period - before;
    motion = motion * std::polar(std::pow(decay, wait), rotation * wait) + jump.size;
    before = jump.period;
  }
  return std::abs(motion);
}

double left_by(const NotchDesign& notch, const NaturalMode& mode, double off = 0.0) {
  return left_of_a_step(jumps_of(notch), mode.decay, mode.rotation * (1.0 + off));
}

/// How far an undamped mode at Table 1 may be off until a step leaves more than a twentieth.
double reach_of(const std::vector<Jump>& jumps) {
  double off = 0.0;
  while (left_of_a_step(jumps, 1.0, table_1_rotation * (1.0 + off)) <= 0.05 &&
         left_of_a_step(jumps, 1.0, table_1_rotation * (1.0 - off)) <= 0.05) {
    off += 1e-4;
  }
  return off;
}

TEST(NotchDesignTest, ThreeTapsLeaveWhatTheirClosedFormSays) {
  const NaturalMode mode{1.0, table_1_rotation};
  const auto notch = design_notch(mode);
  ASSERT_TRUE(notch);
  const std::vector<std::pair<double, double>> stiffness_and_left = {
      {0.8, 0.174254007}, {0.96, 0.033883085}, {1.04, 0.033406722}, {1.2, 0.162343922}};
  for (const auto& [stiffness, left] : stiffness_and_left) {
    EXPECT_NEAR(left_by(*notch, mode, std::sqrt(stiffness) - 1.0), left, 1e-9) << stiffness;
  }
}

TEST(NotchDesignTest, FiveTapsOfAModeThatIsKnownAreTheThreeTwice) {
  const NaturalMode mode{1.0, table_1_rotation};
  const auto notch = design_robust_notch(mode, 1e-6);
  ASSERT_TRUE(notch);
  ASSERT_EQ(notch->tap_count, 5U);
  EXPECT_EQ(notch->spacing, 1);
  const std::vector<double> taps = {0.400671864, -0.336714526, 0.872085326, -0.336714526,
                                    0.400671864};
  for (std::size_t i = 0; i < taps.size(); ++i) {
    EXPECT_NEAR(notch->taps[i], taps[i], 1e-9) << i;
  }
  for (const auto& [stiffness, left] :
       std::vector<std::pair<double, double>>{{0.8, 0.174254007}, {1.2, 0.162343922}}) {
    EXPECT_NEAR(left_by(*notch, mode, std::sqrt(stiffness) - 1.0), left * left, 1e-9);
  }
}

// A zero-vibration-derivative shaper: a quarter, a half and a quarter, half a swing apart.
TEST(NotchDesignTest, ATwentiethReachesFurtherThanAShaperWithADoubleZero) {
  const auto notch = design_robust_notch({1.0, table_1_rotation}, 0.183);
  ASSERT_TRUE(notch);
  EXPECT_LE(notch->ripple, 0.05);
  EXPECT_NEAR(reach_of(jumps_of(*notch)), 0.1850, 2e-4);
  const double half_swing = pi / table_1_rotation;
  EXPECT_NEAR(reach_of({{0.0, 0.25}, {half_swing, 0.5}, {2.0 * half_swing, 0.25}}), 0.1436, 2e-4);
  EXPECT_LT(notch->span(), 2.0 * half_swing);
}

// |p(c)| of the Chebyshev polynomial p is half the square of the half width at most.
TEST(NotchDesignTest, LargestRippleIsThatOfTheChebyshevPolynomial) {
  for (const double range : {0.01, 0.05, 0.1, 0.15, 0.183}) {
    const auto notch = design_robust_notch({1.0, table_1_rotation}, range);
    ASSERT_TRUE(notch) << range;
    ASSERT_EQ(notch->spacing, 1);
    const double low = std::cos(table_1_rotation * (1.0 + range));
    const double high = std::cos(table_1_rotation * (1.0 - range));
    const double middle = 0.5 * (high + low);
    const double half = 0.5 * (high - low);
    const double at_rest = (1.0 - middle) * (1.0 - middle) - 0.5 * half * half;
    EXPECT_NEAR(notch->ripple, 0.5 * half * half / at_rest, 1e-12) << range;
    EXPECT_EQ(notch->range, range);
  }
}

// At two carrier periods the mode of Table 1 is near half a turn, where the cosine hardly changes.
TEST(NotchDesignTest, AWideRangeTakesAWiderSpacing) {
  const auto notch = design_robust_notch({1.0, table_1_rotation}, 0.25);
  ASSERT_TRUE(notch);
  EXPECT_EQ(notch->spacing, 2);
  const double half = 0.5 * (1.0 + std::cos(2.0 * table_1_rotation * 0.75));
  const double at_rest = (2.0 - half) * (2.0 - half) - 0.5 * half * half;
  EXPECT_NEAR(notch->ripple, 0.5 * half * half / at_rest, 1e-5);
}

/// A real number between these, on a fine grid.
double real_between(double low, double high) {
  constexpr int steps = 1'000'000;
  return low +
         (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, steps + 1)) / steps;
}

struct Case {
  NaturalMode mode;
  double range;
};

Case any_case() {
  const bool damped = real_between(0.0, 1.0) < 0.7;
  const double damping = std::pow(10.0, real_between(-6.0, 0.0));
  const double rotation = std::pow(10.0, real_between(-1.5, 1.3));
  return {{damped ? std::exp(-damping) : 1.0, rotation}, std::pow(10.0, real_between(-4.0, -0.31))};
}

/// Checks a property of the robust notches of a thousand cases, most of which have one.
template <class Property>
void check_notches(const char* name, Property property) {
  int served = 0;
  EXPECT_TRUE(rc::check(name, [&] {
    for (int i = 0; i < 10; ++i) {
      const Case some = any_case();
      const auto notch = design_robust_notch(some.mode, some.range);
      if (notch) {
        property(some, *notch);
        ++served;
      }
    }
  }));
  EXPECT_GT(served, 500);
}

TEST(NotchDesignTest, NothingInTheRangeIsLeftRingingByMoreThanPromised) {
  check_notches("promised ripple", [](const Case& some, const NotchDesign& notch) {
    RC_ASSERT(notch.ripple < 0.5);
    RC_ASSERT(notch.spacing >= 1 && notch.spacing <= max_robust_spacing);
    const double off = some.range * real_between(-1.0, 1.0);
    // The largest is looked for at 65 frequencies.
    RC_ASSERT(left_by(notch, some.mode, off) <= notch.ripple * 1.003 + 1e-9);
  });
}

TEST(NotchDesignTest, RoundedTapsAddUpToOneAndOvershootNowhere) {
  check_notches("rounded taps", [](const Case& some, const NotchDesign& notch) {
    const double off = some.range * real_between(-1.0, 1.0);
    for (const int digits : {15, 24, 31, 53}) {
      NotchDesign rounded = notch;
      rounded.taps = rounded_taps(notch, digits);
      const double unit = std::ldexp(1.0, -digits);
      double partial = 0.0;  // exact: each is a whole number of units
      for (std::size_t i = 0; i < rounded.tap_count; ++i) {
        RC_ASSERT(std::fmod(rounded.taps[i], unit) == 0.0);
        RC_ASSERT(std::abs(rounded.taps[i]) < 1.0);
        RC_ASSERT(std::abs(rounded.taps[i] - notch.taps[i]) <= 1.501 * unit + 1e-12);
        partial += rounded.taps[i];
        RC_ASSERT(partial >= 0.0 && partial <= 1.0);
      }
      RC_ASSERT(partial == 1.0);
      RC_ASSERT(left_by(rounded, some.mode, off) <= notch.ripple * 1.003 + 7.5 * unit + 1e-9);
    }
  });
}

TEST(NotchDesignTest, ASpacingIsAsGoodAsAModeThatIsAsMuchQuicker) {
  check_notches("quicker mode", [](const Case& some, const NotchDesign& notch) {
    if (notch.ripple > robust_ripple) {
      return;
    }
    // A mode as much quicker has the same notch at a spacing of 1.
    const double spacing = notch.spacing;
    const NaturalMode quicker{std::pow(some.mode.decay, spacing), some.mode.rotation * spacing};
    const auto alike = design_robust_notch(quicker, some.range);
    RC_ASSERT(alike.has_value() && alike->spacing == 1);
    RC_ASSERT(std::abs(alike->ripple - notch.ripple) < 1e-6);
  });
}

TEST(NotchDesignTest, MostModesHaveARobustNotch) {
  int served = 0;
  int all = 0;
  for (double part = 0.02; part < 0.95; part += 0.003) {
    const auto notch = design_robust_notch({1.0, 2.0 * pi * part}, 0.05);
    served += notch && notch->ripple <= robust_ripple ? 1 : 0;
    ++all;
  }
  EXPECT_GT(served, 0.9 * all);
}

TEST(NotchDesignTest, NothingServesWithoutAModeOrOneThatMayBeOnTheCarrier) {
  EXPECT_FALSE(design_notch({0.5, 0.0}));
  EXPECT_FALSE(design_robust_notch({0.5, 0.0}, 0.1));
  EXPECT_FALSE(design_robust_notch({1.0, 2.0 * pi}, 0.1));
  EXPECT_FALSE(design_robust_notch({1.0, 2.0 * pi * 0.95}, 0.1));
  EXPECT_FALSE(design_robust_notch({1.0, 2.0 * pi * 5.02}, 0.1));
  EXPECT_FALSE(design_robust_notch({1.0, 2.0 * pi / 80.0}, 0.01));
  EXPECT_TRUE(design_robust_notch({1.0, 2.0 * pi / 75.0}, 0.01));
}

TEST(NotchDesignTest, WithoutARangeItIsTheWidestThatLeavesLittle) {
  int narrower = 0;
  int none = 0;
  for (double part = 0.02; part < 3.6; part += 0.0137) {
    const NaturalMode mode{1.0, 2.0 * pi * part};
    const std::optional<NotchDesign> widest = design_widest_notch(mode);
    if (!widest) {
      // Nor is there one for a mode that is known to half a per mille.
      const std::optional<NotchDesign> narrow = design_robust_notch(mode, 5e-4);
      EXPECT_TRUE(!narrow || narrow->ripple > robust_ripple) << part;
      ++none;
      continue;
    }
    EXPECT_LE(notch_ripple(*widest, mode, widest->range), robust_ripple) << part;
    EXPECT_LE(widest->range, default_shaping_range);
    if (widest->range < default_shaping_range) {
      const std::optional<NotchDesign> wider = design_robust_notch(mode, 1.02 * widest->range);
      EXPECT_TRUE(!wider || wider->ripple > robust_ripple) << part;
      ++narrower;
    }
  }
  EXPECT_GT(narrower, 20);
  EXPECT_GT(none, 0);
  EXPECT_EQ(design_widest_notch({1.0, 1.359125536})->range, default_shaping_range);  // Table 1
}

scene::Tolerance tolerance_of(const char* key, double nominal, double amount) {
  return {key,     scene::Spread::half_width, amount,
          nominal, nominal * (1.0 - amount),  nominal * (1.0 + amount)};
}

TEST(NotchDesignTest, ItsRangeHoldsEveryFrequencyThatTheTolerancesLeave) {
  EXPECT_FALSE(tolerated_shaping_range({}));
  EXPECT_FALSE(tolerated_shaping_range({tolerance_of("friction.coefficient", 0.1, 0.3)}));
  rc::check([] {
    const double stiffness = *rc::gen::inRange(0, 60) / 100.0;
    const double mass = *rc::gen::inRange(1, 30) / 100.0;
    const double range =
        tolerated_shaping_range({tolerance_of("plant.stiffness_N_per_m", 133e6, stiffness),
                                 tolerance_of("plant.mass_kg", 0.02, mass)})
            .value();
    double widest = 0.0;
    for (const double k : {1.0 - stiffness, 1.0 + stiffness}) {
      for (const double m : {1.0 - mass, 1.0 + mass}) {
        widest = std::max(widest, std::abs(std::sqrt(k / m) - 1.0));
      }
    }
    RC_ASSERT(std::abs(range - std::min(widest, 0.5)) < 1e-12);
  });
}

TEST(NotchDesignTest, ANormalToleranceCountsForThreeDeviations) {
  scene::Tolerance normal = tolerance_of("plant.stiffness_N_per_m", 133e6, 0.02);
  normal.spread = scene::Spread::normal;
  normal.lowest = 0.0;
  normal.highest = 1e12;
  EXPECT_NEAR(tolerated_shaping_range({normal}).value(), 1.0 - std::sqrt(0.94), 1e-12);
}

}  // namespace
}  // namespace sonoglide::configure::notch_design_test
