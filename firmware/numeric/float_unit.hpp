/// Conversions for which a floating-point unit has an instruction and C++ no word.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/numeric/float_format.hpp"

namespace sonoglide::numeric {

/// Whether conversions between converter codes and this format are instructions.
#if defined(__thumb2__) && defined(__ARM_FP)
template <class Float>
inline constexpr bool converts_codes = std::is_same_v<Float, float>;
#else
template <class Float>
inline constexpr bool converts_codes = false;
#endif

/// code * 2^-31, rounded to nearest, ties to even, in any rounding mode.
template <class Float>
Float code_to_float(std::int32_t code) {
  static_assert(converts_codes<Float>);
  auto x = from_bits<Float>(static_cast<std::uint32_t>(code));
#if defined(__thumb2__) && defined(__ARM_FP)
  asm("vcvt.f32.s32 %[x], %[x], #31" : [x] "+t"(x));
#endif
  return x;
}

/// x * 2^31 without the digits after the point, limited to the range of a code. NaN gives 0.
template <class Float>
std::int32_t float_to_code(Float x) {
  static_assert(converts_codes<Float>);
#if defined(__thumb2__) && defined(__ARM_FP)
  asm("vcvt.s32.f32 %[x], %[x], #31" : [x] "+t"(x));
#endif
  return static_cast<std::int32_t>(to_bits(x));
}

}  // namespace sonoglide::numeric
