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

/// x^(1/Degree) within 7 %, x > 0 and normal. As plant::quick_root, the bits being taken for the
/// logarithm; lanes have no integer division, so a product of reals stands in for it.
template <int Degree, class D>
HWY_INLINE hn::Vec<D> quick_root(D d, hn::Vec<D> x) {
  using Scalar = hn::TFromD<D>;
  constexpr Scalar share = Scalar(1) / Degree;
  if constexpr (sizeof(Scalar) == sizeof(float)) {
    const hn::RebindToSigned<D> integers;
    constexpr float bits_of_one = 0x3F800000p0F;
    const auto logarithm = hn::ConvertTo(d, hn::BitCast(integers, x));
    const auto root =
        fused(logarithm, hn::Set(d, share), hn::Set(d, bits_of_one - bits_of_one * share));
    return hn::BitCast(d, hn::ConvertTo(integers, root));
  } else {
    // An integer below 2^52 in the mantissa of 2^52 is converted without an instruction for it.
    const hn::RebindToUnsigned<D> integers;
    constexpr int dropped = 20;
    constexpr double bits_of_one =
        static_cast<double>(std::uint64_t{0x3FF0000000000000} >> dropped);
    const auto carrier = hn::Set(d, 0x1p52);
    const auto carrier_bits = hn::BitCast(integers, carrier);
    const auto bits = hn::ShiftRight<dropped>(hn::BitCast(integers, x));
    const auto logarithm = hn::Sub(hn::BitCast(d, hn::Or(bits, carrier_bits)), carrier);
    const auto root =
        fused(logarithm, hn::Set(d, share), hn::Set(d, bits_of_one - bits_of_one * share));
    const auto root_bits = hn::BitCast(integers, hn::Add(root, carrier));
    return hn::BitCast(d, hn::ShiftLeft<dropped>(hn::Xor(root_bits, carrier_bits)));
  }
}

template <int Degree, class D>
HWY_INLINE Pack<D> quick_root(D d, Pack<D> x) {
  return {quick_root<Degree>(d, x.first), quick_root<Degree>(d, x.second)};
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
