/// The quick root that step-size control needs, in lanes. Compiled once for each instruction set.
#if defined(SONOGLIDE_BATCH_STEP_SIZE_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_STEP_SIZE_LANES
#undef SONOGLIDE_BATCH_STEP_SIZE_LANES
#else
#define SONOGLIDE_BATCH_STEP_SIZE_LANES
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "host_sim/batch/lane_pack.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Of a double, so that what is left of its exponent and mantissa fits the mantissa of another.
inline constexpr int dropped_bits = 20;

/// The bits of x >= 0, taken for its logarithm, as a real number.
template <class D>
HWY_INLINE hn::Vec<D> logarithm_in_bits(D d, hn::Vec<D> x) {
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(float)) {
    return hn::ConvertTo(d, hn::BitCast(hn::RebindToSigned<D>(), x));
  } else {
    // An integer below 2^52 in the mantissa of 2^52 is converted without an instruction for it.
    const hn::RebindToUnsigned<D> integers;
    const auto carrier = hn::Set(d, 0x1p52);
    const auto bits = hn::ShiftRight<dropped_bits>(hn::BitCast(integers, x));
    return hn::Sub(hn::BitCast(d, hn::Or(bits, hn::BitCast(integers, carrier))), carrier);
  }
}

/// (a / b)^(1/Degree) within 8 %, a and b normal; for b = 0 a larger number. As
/// numeric::quick_root_of_quotient; lanes have no integer division, so a product of reals stands in
/// for it.
template <int Degree, class D>
HWY_INLINE hn::Vec<D> quick_root_of_quotient(D d, hn::Vec<D> a, hn::Vec<D> b) {
  using Scalar = hn::TFromD<D>;
  constexpr Scalar share = Scalar(1) / Degree;
  const auto logarithm = hn::Sub(logarithm_in_bits(d, a), logarithm_in_bits(d, b));
  if constexpr (sizeof(Scalar) == sizeof(float)) {
    const auto root = fused(logarithm, hn::Set(d, share), hn::Set(d, 0x3F800000p0F));
    return hn::BitCast(d, hn::ConvertTo(hn::RebindToSigned<D>(), root));
  } else {
    const hn::RebindToUnsigned<D> integers;
    constexpr auto bits_of_one =
        static_cast<double>(std::uint64_t{0x3FF0000000000000} >> dropped_bits);
    const auto carrier = hn::Set(d, 0x1p52);
    const auto root = fused(logarithm, hn::Set(d, share), hn::Set(d, bits_of_one));
    const auto root_bits = hn::BitCast(integers, hn::Add(root, carrier));
    return hn::BitCast(
        d, hn::ShiftLeft<dropped_bits>(hn::Xor(root_bits, hn::BitCast(integers, carrier))));
  }
}

template <int Degree, class D>
HWY_INLINE Pack<D> quick_root_of_quotient(D d, Pack<D> a, Pack<D> b) {
  return {quick_root_of_quotient<Degree>(d, a.first, b.first),
          quick_root_of_quotient<Degree>(d, a.second, b.second)};
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
