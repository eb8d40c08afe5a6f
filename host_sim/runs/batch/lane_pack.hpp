/// Two vectors that are worked on side by side: the long chains of dependent operations of one fill
/// the waits of the other. Compiled once for each instruction set.
#if defined(SONOGLIDE_BATCH_LANE_PACK) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_LANE_PACK
#undef SONOGLIDE_BATCH_LANE_PACK
#else
#define SONOGLIDE_BATCH_LANE_PACK
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstring>

#include "host_sim/runs/batch/fused_by_parts.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whether products with a sum are rounded once. An instruction set without a fused multiply-add would
/// round twice, and the last bit would tell which machine has computed a point: there each lane is put
/// together from parts, which takes long and has the same bits.
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

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Operations have the names and meanings of Highway's, lane by lane.
template <class D>
struct Pack {
  hn::Vec<D> first;
  hn::Vec<D> second;

  static_assert(sizeof(hn::Vec<D>) == hn::MaxLanes(D()) * sizeof(hn::TFromD<D>),
                "lanes are addressed as an array");
};

/// A yes or no for each lane of a pack.
template <class D>
struct Choice {
  hn::Mask<D> first;
  hn::Mask<D> second;
};

template <class D>
constexpr std::size_t pack_lanes(D d) {
  return 2 * hn::MaxLanes(d);
}

template <class D>
HWY_INLINE Pack<D> broadcast(D d, hn::TFromD<D> value) {
  return {hn::Set(d, value), hn::Set(d, value)};
}
template <class D>
HWY_INLINE Pack<D> zeros(D d) {
  return {hn::Zero(d), hn::Zero(d)};
}

template <class D>
HWY_INLINE Pack<D> operator+(Pack<D> a, Pack<D> b) {
  return {hn::Add(a.first, b.first), hn::Add(a.second, b.second)};
}
template <class D>
HWY_INLINE Pack<D> operator-(Pack<D> a, Pack<D> b) {
  return {hn::Sub(a.first, b.first), hn::Sub(a.second, b.second)};
}
template <class D>
HWY_INLINE Pack<D> operator*(Pack<D> a, Pack<D> b) {
  return {hn::Mul(a.first, b.first), hn::Mul(a.second, b.second)};
}
template <class D>
HWY_INLINE Pack<D> operator/(Pack<D> a, Pack<D> b) {
  return {hn::Div(a.first, b.first), hn::Div(a.second, b.second)};
}
template <class D>
HWY_INLINE Pack<D> MulAdd(Pack<D> a, Pack<D> b, Pack<D> c) {
  return {fused(a.first, b.first, c.first), fused(a.second, b.second, c.second)};
}
template <class D>
HWY_INLINE Pack<D> NegMulAdd(Pack<D> a, Pack<D> b, Pack<D> c) {
  return {fused_negative(a.first, b.first, c.first), fused_negative(a.second, b.second, c.second)};
}
template <class D>
HWY_INLINE Pack<D> Neg(Pack<D> a) {
  return {hn::Neg(a.first), hn::Neg(a.second)};
}
template <class D>
HWY_INLINE Pack<D> Abs(Pack<D> a) {
  return {hn::Abs(a.first), hn::Abs(a.second)};
}
template <class D>
HWY_INLINE Pack<D> CopySign(Pack<D> magnitude, Pack<D> sign) {
  return {hn::CopySign(magnitude.first, sign.first), hn::CopySign(magnitude.second, sign.second)};
}
template <class D>
HWY_INLINE Pack<D> Min(Pack<D> a, Pack<D> b) {
  return {hn::Min(a.first, b.first), hn::Min(a.second, b.second)};
}
template <class D>
HWY_INLINE Pack<D> Max(Pack<D> a, Pack<D> b) {
  return {hn::Max(a.first, b.first), hn::Max(a.second, b.second)};
}
template <class D>
HWY_INLINE Pack<D> Clamp(Pack<D> x, Pack<D> lowest, Pack<D> highest) {
  return Min(Max(x, lowest), highest);
}
template <class D>
HWY_INLINE Pack<D> Sqrt(Pack<D> a) {
  return {hn::Sqrt(a.first), hn::Sqrt(a.second)};
}
template <class D>
HWY_INLINE Pack<D> Expm1(D d, Pack<D> x) {
  return {hn::Expm1(d, x.first), hn::Expm1(d, x.second)};
}

template <class D>
HWY_INLINE Choice<D> operator==(Pack<D> a, Pack<D> b) {
  return {hn::Eq(a.first, b.first), hn::Eq(a.second, b.second)};
}
template <class D>
HWY_INLINE Choice<D> operator<(Pack<D> a, Pack<D> b) {
  return {hn::Lt(a.first, b.first), hn::Lt(a.second, b.second)};
}
template <class D>
HWY_INLINE Choice<D> operator<=(Pack<D> a, Pack<D> b) {
  return {hn::Le(a.first, b.first), hn::Le(a.second, b.second)};
}
template <class D>
HWY_INLINE Choice<D> operator>(Pack<D> a, Pack<D> b) {
  return b < a;
}
template <class D>
HWY_INLINE Choice<D> operator>=(Pack<D> a, Pack<D> b) {
  return b <= a;
}
template <class D>
HWY_INLINE Choice<D> And(Choice<D> a, Choice<D> b) {
  return {hn::And(a.first, b.first), hn::And(a.second, b.second)};
}
template <class D>
HWY_INLINE Choice<D> AndNot(Choice<D> not_a, Choice<D> b) {
  return {hn::AndNot(not_a.first, b.first), hn::AndNot(not_a.second, b.second)};
}
template <class D>
HWY_INLINE Choice<D> Or(Choice<D> a, Choice<D> b) {
  return {hn::Or(a.first, b.first), hn::Or(a.second, b.second)};
}
template <class D>
HWY_INLINE Choice<D> Not(Choice<D> a) {
  return {hn::Not(a.first), hn::Not(a.second)};
}
template <class D>
HWY_INLINE bool AllFalse(D d, Choice<D> a) {
  return hn::AllFalse(d, hn::Or(a.first, a.second));
}
template <class D>
HWY_INLINE Pack<D> IfThenElse(Choice<D> choice, Pack<D> yes, Pack<D> no) {
  return {hn::IfThenElse(choice.first, yes.first, no.first),
          hn::IfThenElse(choice.second, yes.second, no.second)};
}
template <class D>
HWY_INLINE Pack<D> IfThenElseZero(Choice<D> choice, Pack<D> yes) {
  return {hn::IfThenElseZero(choice.first, yes.first),
          hn::IfThenElseZero(choice.second, yes.second)};
}
template <class D>
HWY_INLINE Pack<D> IfThenZeroElse(Choice<D> choice, Pack<D> no) {
  return {hn::IfThenZeroElse(choice.first, no.first), hn::IfThenZeroElse(choice.second, no.second)};
}

template <class D>
hn::TFromD<D> lane_of(const Pack<D>& pack, std::size_t lane) {
  hn::TFromD<D> value;
  std::memcpy(&value, reinterpret_cast<const char*>(&pack) + lane * sizeof(value), sizeof(value));
  return value;
}
template <class D>
void set_lane(Pack<D>& pack, std::size_t lane, hn::TFromD<D> value) {
  std::memcpy(reinterpret_cast<char*>(&pack) + lane * sizeof(value), &value, sizeof(value));
}
/// 1 where chosen, else 0.
template <class D>
HWY_INLINE Pack<D> indicator(D d, Choice<D> choice) {
  return IfThenElseZero(choice, broadcast(d, hn::TFromD<D>(1)));
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
