/// What a composition leaves out costs no byte.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "design.hpp"
#include "scalars.hpp"

namespace sonoglide::control::size_test {
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
  EXPECT_TRUE(std::is_empty_v<NoRelearning<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<FullDrive<TypeParam>>);
  EXPECT_TRUE(std::is_empty_v<StrictSamples>);
}

// Three configured numbers, three of state, four bytes of flags; the rest are the parts at work.
TYPED_TEST(ControllerSize, TheBareControllerIsTheSumOfWhatItUses) {
  using S = TypeParam;
  constexpr std::size_t used =
      6 * sizeof(S) + sizeof(SpeedForesight<S>) + sizeof(IntegralRegulator<S, longest_delay>) +
      sizeof(StandstillHold<S>) + sizeof(StuckDetector<S>) + sizeof(Plausibility<S>) +
      sizeof(SettlingWatch<S>) + sizeof(FrictionLevel<S>) + 4;
  EXPECT_LT(bytes<BareParts<S>>, used + 2 * alignof(S));
  EXPECT_LT(parameter_bytes<BareParts<S>>,
            4 * sizeof(S) + sizeof(typename IntegralRegulator<S, longest_delay>::Parameters) +
                sizeof(typename StandstillHold<S>::Parameters) +
                sizeof(typename StuckDetector<S>::Parameters) +
                sizeof(typename Plausibility<S>::Parameters) +
                sizeof(typename SettlingWatch<S>::Parameters) + 2 * alignof(S));
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
TYPED_TEST(ControllerSize, TheDelayLineIsAsLongAsTheNotch) {
  EXPECT_EQ(sizeof(NotchShaper<TypeParam, 9>) - sizeof(NotchShaper<TypeParam, 2>),
            14 * sizeof(TypeParam));
  EXPECT_EQ((sizeof(NotchShaper<TypeParam, 9, 5>) - sizeof(NotchShaper<TypeParam, 2, 5>)),
            28 * sizeof(TypeParam));
  // With a spacing of 1 there is no index.
  EXPECT_GT(sizeof(NotchShaper<TypeParam, 2>) - sizeof(NotchShaper<TypeParam, 1>),
            2 * sizeof(TypeParam));
}

}  // namespace
}  // namespace sonoglide::control::size_test
