/// The controller gives the same bits whatever the compiler and its optimisation: a hash of every
/// command of a scripted closed loop is compared with the value that every build so far has had.
///
/// A deliberate change of the controller changes its hash; anything else that does is a fault.

#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/numeric/float_format.hpp"
#include "scalars.hpp"
#include "scripted_run.hpp"

namespace sonoglide::control::same_bits_test {
namespace {

template <class Scalar>
std::uint64_t bits_of(Scalar x) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return static_cast<std::uint64_t>(x.raw());
  } else {
    return numeric::to_bits(x);
  }
}

/// FNV-1a over the commands of 20 000 periods.
template <class PartsT>
std::uint64_t hash_of_commands() {
  std::uint64_t hash = 0xCBF29CE484222325U;
  const auto add = [&hash](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte, word >>= 8) {
      hash = (hash ^ (word & 0xFFU)) * 0x100000001B3U;
    }
  };
  scripted_run<PartsT>(7, 20'000, [&](int /*period*/, const ClosedLoop<PartsT>& loop) {
    add(bits_of(loop.command().amplitude));
    add(static_cast<std::uint64_t>(loop.command().state));
    add(static_cast<std::uint64_t>(loop.command().limit));
    add(static_cast<std::uint64_t>(loop.command().fault));
  });
  return hash;
}

TEST(SameBits, ShapedController) {
  EXPECT_EQ(hash_of_commands<ShapedParts<double>>(), 0x4AA8BEDA07A7CD7CU);
  EXPECT_EQ(hash_of_commands<ShapedParts<float>>(), 0x3E496B765ADCA56FU);
  EXPECT_EQ(hash_of_commands<ShapedParts<Saturated>>(), 0x5690028490170E35U);
  EXPECT_EQ(hash_of_commands<ShapedParts<ShortTrapped>>(), 0xCC5492F28A5CEDBFU);
}

TEST(SameBits, ControllerWithFiveTaps) {
  EXPECT_EQ(hash_of_commands<RobustParts<double>>(), 0x1F9FC59D2C1893F0U);
  EXPECT_EQ(hash_of_commands<RobustParts<float>>(), 0xAB90E3BF56190C56U);
  EXPECT_EQ(hash_of_commands<RobustParts<Saturated>>(), 0x0828B9FBD54590EDU);
  EXPECT_EQ(hash_of_commands<RobustParts<ShortTrapped>>(), 0x304F3B16E54BE684U);
}

TEST(SameBits, FullController) {
  EXPECT_EQ(hash_of_commands<FullParts<double>>(), 0x36F40C53B77A3403U);
  EXPECT_EQ(hash_of_commands<FullParts<float>>(), 0x046837E69B88A06BU);
  EXPECT_EQ(hash_of_commands<FullParts<Saturated>>(), 0x2296E8463F2AA508U);
  EXPECT_EQ(hash_of_commands<FullParts<ShortTrapped>>(), 0xBCF4ADC5F551BFF9U);
}

TEST(SameBits, BareController) {
  EXPECT_EQ(hash_of_commands<BareParts<double>>(), 0x8216420063688DBEU);
  EXPECT_EQ(hash_of_commands<BareParts<float>>(), 0xFA9BC547EE4FF2EBU);
  EXPECT_EQ(hash_of_commands<BareParts<Saturated>>(), 0x05C565AF0015F375U);
}

TEST(SameBits, OverflowPolicyChangesNoBit) {
  EXPECT_EQ(hash_of_commands<FullParts<Trapped>>(), hash_of_commands<FullParts<Saturated>>());
  EXPECT_EQ(hash_of_commands<FullParts<numeric::Q31<numeric::Counting>>>(),
            hash_of_commands<FullParts<Saturated>>());
}

}  // namespace
}  // namespace sonoglide::control::same_bits_test
