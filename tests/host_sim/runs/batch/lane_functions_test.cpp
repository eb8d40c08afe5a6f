/// The elementary functions of lanes against the C library's.
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>

#include "host_sim/runs/batch/elementary_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Float>
class LaneFunctions : public testing::Test {
 public:
  using D = hn::ScalableTag<Float>;

  static double first_lane(hn::Vec<D> v) { return static_cast<double>(hn::GetLane(v)); }
  static hn::Vec<D> lanes(Float value) { return hn::Set(D(), value); }
};

using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(LaneFunctions, Floats, );

constexpr int count = 100000;

TYPED_TEST(LaneFunctions, SineAndCosineAreWithinTheirError) {
  using Float = TypeParam;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<Float> angle(-10, 10);
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    const Float x = i == 0 ? Float{0} : angle(random);
    const auto turn = sine_and_cosine(typename TestFixture::D(), this->lanes(x));
    const auto exact = static_cast<double>(x);
    worst = std::max({worst, std::abs(this->first_lane(turn.sine) - std::sin(exact)),
                      std::abs(this->first_lane(turn.cosine) - std::cos(exact))});
  }
  const bool narrow = std::is_same_v<Float, float>;
  EXPECT_LT(worst, narrow ? 3e-7 : 3e-14);
  EXPECT_GT(worst, narrow ? 6e-8 : 3e-15);
}

TYPED_TEST(LaneFunctions, DecayIsWithinItsError) {
  using Float = TypeParam;
  constexpr int degree = std::is_same_v<Float, float> ? 5 : 9;
  std::mt19937_64 random(8);
  std::uniform_real_distribution<Float> exponent(0, 80);
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    const Float z = exponent(random);
    const double found = this->first_lane(decay<degree>(typename TestFixture::D(), this->lanes(z)));
    worst = std::max(worst, std::abs(found * std::exp(static_cast<double>(z)) - 1.0));
  }
  EXPECT_LT(worst, (std::is_same_v<Float, float> ? 4e-6 : 1e-11));
  EXPECT_GE(this->first_lane(decay<degree>(typename TestFixture::D(), this->lanes(1000))), 1e-35);
}

TYPED_TEST(LaneFunctions, QuickRootsAreWithinTheirError) {
  using Float = TypeParam;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> binary_logarithm(-30, 30);
  for (int i = 0; i < count; ++i) {
    const double a = std::exp2(binary_logarithm(random));
    const double b = std::exp2(binary_logarithm(random));
    const double found = this->first_lane(
        quick_root_of_quotient<11>(typename TestFixture::D(), this->lanes(static_cast<Float>(a)),
                                   this->lanes(static_cast<Float>(b))));
    ASSERT_NEAR(found / std::pow(a / b, 1.0 / 11), 1.0, 0.08) << a << " / " << b;
  }
  EXPECT_GT(this->first_lane(quick_root_of_quotient<11>(typename TestFixture::D(), this->lanes(1),
                                                        this->lanes(0))),
            100.0);
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
