/// What a composition leaves out costs no byte.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "design.hpp"
#include "scalars.hpp"

namespace sonoglide::control {
namespace {

template <class S>
class ControllerSize : public testing::Test {};
using Stored = testing::Types<double, float, Saturated>;
TYPED_TEST_SUITE(ControllerSize, Stored);

template <class PartsT>
constexpr std::size_t bytes = sizeof(Controller<PartsT>);
template <class PartsT>
constexpr std::size_t parameter_bytes = sizeof(typename Controller<PartsT>::Parameters);

TYPED_TEST(ControllerSize, PartsThatDoNothingAreEmpty) {
  EXPECT_TRUE(std::is_empty_v<TrustedFriction<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<CoulombFeedforward<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<NoSlewLimit<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<NoShaping<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<FullDrive<TypeParam>>);
}

// Three configured numbers, five of state, three bytes of flags; the rest are the parts at work.
TYPED_TEST(ControllerSize, TheBareControllerIsTheSumOfWhatItUses) {
  constexpr std::size_t used = 8 * sizeof(TypeParam) + sizeof(IntegralRegulator<TypeParam>) +
                               sizeof(StuckDetector<TypeParam>) + sizeof(FrictionLevel<TypeParam>) +
                               3;
  EXPECT_LT(bytes<BareParts<TypeParam>>, used + alignof(TypeParam));
  EXPECT_LT(parameter_bytes<BareParts<TypeParam>>,
            3 * sizeof(TypeParam) + sizeof(typename IntegralRegulator<TypeParam>::Parameters) +
                sizeof(typename StuckDetector<TypeParam>::Parameters) + alignof(TypeParam));
}

TYPED_TEST(ControllerSize, EachPartLeftOutSavesItsState) {
  using Bare = BareParts<TypeParam>;
  using Unshaped = UnshapedParts<TypeParam>;
  constexpr std::size_t delay_line = 2 * longest_spacing * sizeof(TypeParam);
  // Less what padding it may fill.
  constexpr std::size_t calibration =
      2 * sizeof(TypeParam) + 3 * sizeof(std::uint32_t) - (alignof(std::size_t) - 1);
  EXPECT_GE(bytes<Unshaped>, bytes<Bare> + 2 * sizeof(TypeParam));
  EXPECT_GE(bytes<SlewingParts<TypeParam>>, bytes<Unshaped> + sizeof(TypeParam));
  EXPECT_GE(bytes<ShapedParts<TypeParam>>, bytes<Unshaped> + 3 * sizeof(TypeParam) + delay_line);
  EXPECT_GE(bytes<LearningParts<TypeParam>>, bytes<ShapedParts<TypeParam>> + calibration);
  EXPECT_GE(bytes<FullParts<TypeParam>>, bytes<LearningParts<TypeParam>> + sizeof(TypeParam));
}

// An image is built for its plant: the delay line is as long as the notch needs, not longer.
TYPED_TEST(ControllerSize, TheDelayLineIsTwoSpacings) {
  EXPECT_EQ(sizeof(NotchShaper<TypeParam, 9>) - sizeof(NotchShaper<TypeParam, 1>),
            16 * sizeof(TypeParam));
}

}  // namespace
}  // namespace sonoglide::control
