/// The closed-form friction-ratio map in lanes. Compiled once for each instruction set.
#if defined(SONOGLIDE_BATCH_RATIO_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_RATIO_LANES
#undef SONOGLIDE_BATCH_RATIO_LANES
#else
#define SONOGLIDE_BATCH_RATIO_LANES
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "host_sim/batch/arc_lanes.hpp"
#include "host_sim/batch/step_size_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

/// The formula of friction::dahl_friction_ratio, 0 <= r < 1, with θ* = π − arccos(r).
HWY_INLINE V ratio_of_reversing_contact(D d, V r, V a) {
  constexpr double pi = 3.14159265358979323846;
  constexpr double negligible_exponent = 28.0;
  const V two = hn::Set(d, 2.0);
  const V least_drift = hn::Set(d, 1e-12);
  const V sine = hn::Sqrt(hn::NegMulAdd(r, r, hn::Set(d, 1.0)));
  const V arccosine = hn::Acos(d, r);
  const V backward_length = two * arccosine;
  const ArcLanes<D> forward(sine, r, hn::Set(d, 2.0 * pi) - backward_length);
  const ArcLanes<D> backward(sine, hn::Neg(r), backward_length);

  // On the forward arc 1 - cos x lies between 2 (x/π)², up to x = π, and x²/2, and x - sin x
  // between x³/39.5 and x³/6; the backward travel lies between x²/6 and x²/2. The quick root is
  // within 7 %.
  const V travel = hn::Set(d, negligible_exponent) / a;
  const V quadratic = hn::Sqrt(travel / sine);
  const V cubic = quick_root<3>(d, travel / hn::Max(r, least_drift));
  const V forward_least = hn::Min(quadratic, hn::Set(d, 1.3) * cubic);
  const V forward_most = hn::Min(hn::Set(d, 2.23) * quadratic, hn::Set(d, 3.7) * cubic);
  const V forward_integral = forward.relaxation_integral(d, a, forward_least, forward_most);
  const V backward_integral = backward.relaxation_integral(d, a, hn::Set(d, 1.41) * quadratic,
                                                           hn::Set(d, 2.46) * quadratic);

  const V forward_exponent = hn::Neg(a * forward.travel(d, forward.length));
  const V backward_exponent =
      hn::Min(hn::Neg(a * backward.travel(d, backward.length)), hn::Zero(d));
  const V scale = two / hn::Expm1(d, forward_exponent + backward_exponent);
  const V after_backward = scale * hn::Expm1(d, backward_exponent);
  const V after_forward = scale * hn::Expm1(d, forward_exponent);
  V sum = hn::NegMulAdd(hn::Set(d, 4.0), arccosine, hn::Set(d, 2.0 * pi));
  sum = hn::NegMulAdd(after_backward, forward_integral, sum);
  sum = hn::MulAdd(after_forward, backward_integral, sum);
  return hn::Clamp(sum * hn::Set(d, 0.5 / pi), hn::Zero(d), hn::Set(d, 1.0));
}

HWY_INLINE V ratio(D d, V velocity_ratio, V dahl_number) {
  const V r = hn::Abs(velocity_ratio);
  const auto reverses = hn::Lt(r, hn::Set(d, 1.0));
  const V value = ratio_of_reversing_contact(d, hn::IfThenElseZero(reverses, r), dahl_number);
  return hn::IfThenElse(reverses, value, hn::Set(d, 1.0));
}

inline void fill_ratios(const double* velocity_ratios, const double* dahl_numbers,
                        std::size_t count, double* ratios) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    hn::StoreU(ratio(d, hn::LoadU(d, velocity_ratios + i), hn::LoadU(d, dahl_numbers + i)), d,
               ratios + i);
  }
  if (i < count) {
    std::array<double, hn::MaxLanes(D())> r{};
    std::array<double, hn::MaxLanes(D())> a{};
    a.fill(1.0);
    std::copy(velocity_ratios + i, velocity_ratios + count, r.begin());
    std::copy(dahl_numbers + i, dahl_numbers + count, a.begin());
    hn::StoreU(ratio(d, hn::LoadU(d, r.data()), hn::LoadU(d, a.data())), d, r.data());
    std::copy_n(r.begin(), count - i, ratios + i);
  }
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
