/// The exponential that the friction quadrature needs, in lanes. Compiled once for each instruction
/// set.
#if defined(SONOGLIDE_BATCH_DECAY_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_DECAY_LANES
#undef SONOGLIDE_BATCH_DECAY_LANES
#else
#define SONOGLIDE_BATCH_DECAY_LANES
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "host_sim/batch/factorials.hpp"
#include "host_sim/batch/lane_pack.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// exp(-z), z >= 0, by a series of degree `Degree` about the nearest power of two.
/// Relative error 1e-11 (degree 9, double), 4e-6 (degree 5, float) up to z = 80; never below 1e-35.
template <int Degree, class D>
HWY_INLINE hn::Vec<D> decay(D d, hn::Vec<D> z) {
  using Scalar = hn::TFromD<D>;
  const hn::RebindToSigned<D> integers;
  constexpr bool narrow = sizeof(Scalar) == sizeof(float);
  constexpr int mantissa_bits = narrow ? 23 : 52;
  // Adding it rounds to an integer, which the lowest bits then hold.
  const auto rounder = hn::Set(d, narrow ? Scalar(0x1.8p23) : Scalar(0x1.8p52));
  const auto bounded = hn::Min(z, hn::Set(d, Scalar(80)));
  const auto shifted = fused_negative(bounded, hn::Set(d, Scalar(1.4426950408889634)), rounder);
  const auto exponent = hn::ShiftLeft<mantissa_bits>(hn::BitCast(integers, shifted));
  const auto rest =
      hn::Neg(fused(hn::Sub(shifted, rounder), hn::Set(d, Scalar(0.6931471805599453)), bounded));
  auto sum = hn::Set(d, static_cast<Scalar>(reciprocal_factorials[Degree]));
  HWY_UNROLL(16)
  for (int n = Degree - 1; n >= 0; --n) {
    const double coefficient = reciprocal_factorials[static_cast<std::size_t>(n)];
    sum = fused(sum, rest, hn::Set(d, static_cast<Scalar>(coefficient)));
  }
  return hn::BitCast(d, hn::Add(hn::BitCast(integers, sum), exponent));
}

template <int Degree, class D>
HWY_INLINE Pack<D> decay(D d, Pack<D> z) {
  return {decay<Degree>(d, z.first), decay<Degree>(d, z.second)};
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
