/// The controller gives the same bits whatever the compiler and its optimisation: a hash of every
/// command of a scripted closed loop is compared with the value that every build so far has had.
///
/// A deliberate change of the controller changes its hash; anything else that does is a fault.

#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/numeric/float_format.hpp"
#include "scalars.hpp"
#include "scripted_run.hpp"

namespace sonoglide::control {
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
  EXPECT_EQ(hash_of_commands<ShapedParts<double>>(), 0x5C6CB45B6B123885U);
  EXPECT_EQ(hash_of_commands<ShapedParts<float>>(), 0xFF5D184D714CE463U);
  EXPECT_EQ(hash_of_commands<ShapedParts<Saturated>>(), 0x967045F6DD6F74ACU);
  EXPECT_EQ(hash_of_commands<ShapedParts<ShortTrapped>>(), 0x6DCE78D16F4C6CCBU);
}

TEST(SameBits, FullController) {
  EXPECT_EQ(hash_of_commands<FullParts<double>>(), 0xCDEB4D34D0DC6E42U);
  EXPECT_EQ(hash_of_commands<FullParts<float>>(), 0x9AA1493FBF8F388DU);
  EXPECT_EQ(hash_of_commands<FullParts<Saturated>>(), 0xCD07F9DC19A1B686U);
  EXPECT_EQ(hash_of_commands<FullParts<ShortTrapped>>(), 0x316697D550F4B1D6U);
}

TEST(SameBits, BareController) {
  EXPECT_EQ(hash_of_commands<BareParts<double>>(), 0x1966C29C58F70421U);
  EXPECT_EQ(hash_of_commands<BareParts<float>>(), 0xB867D70DC1C49379U);
  EXPECT_EQ(hash_of_commands<BareParts<Saturated>>(), 0x2EFBD59A7C2490EFU);
}

TEST(SameBits, OverflowPolicyChangesNoBit) {
  EXPECT_EQ(hash_of_commands<FullParts<Trapped>>(), hash_of_commands<FullParts<Saturated>>());
  EXPECT_EQ(hash_of_commands<FullParts<numeric::Q31<numeric::Counting>>>(),
            hash_of_commands<FullParts<Saturated>>());
}

}  // namespace
}  // namespace sonoglide::control
