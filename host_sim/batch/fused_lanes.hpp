/// Products with a sum, rounded once. An instruction set without a fused multiply-add would round
/// twice, and the last bit would tell which machine has computed a point: there each lane is put
/// together from parts, which takes long and has the same bits. Compiled once for each instruction
/// set.
#if defined(SONOGLIDE_BATCH_FUSED_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_FUSED_LANES
#undef SONOGLIDE_BATCH_FUSED_LANES
#else
#define SONOGLIDE_BATCH_FUSED_LANES
#endif

#include <hwy/highway.h>

#include <array>

#include "host_sim/batch/fused_by_parts.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr bool has_fused_lanes =
    HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_SSSE3 && HWY_TARGET != HWY_SSE4;

/// a b + c
template <class V>
HWY_INLINE V fused(V a, V b, V c) {
  if constexpr (has_fused_lanes) {
    return hn::MulAdd(a, b, c);
  } else {
    const hn::DFromV<V> d;
    using Lanes = std::array<hn::TFromD<decltype(d)>, hn::MaxLanes(hn::DFromV<V>())>;
    Lanes lanes;
    Lanes factors;
    Lanes sums;
    hn::StoreU(a, d, lanes.data());
    hn::StoreU(b, d, factors.data());
    hn::StoreU(c, d, sums.data());
    fuse(lanes.data(), factors.data(), sums.data(), lanes.size());
    return hn::LoadU(d, sums.data());
  }
}
/// c - a b
template <class V>
HWY_INLINE V fused_negative(V a, V b, V c) {
  return fused(hn::Neg(a), b, c);
}
/// a b - c
template <class V>
HWY_INLINE V fused_difference(V a, V b, V c) {
  return fused(a, b, hn::Neg(c));
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

// Highway's elementary functions take these too.
#define MulAdd sonoglide::batch::HWY_NAMESPACE::fused
#define MulSub sonoglide::batch::HWY_NAMESPACE::fused_difference
#include <hwy/contrib/math/math-inl.h>
#undef MulAdd
#undef MulSub

#endif
