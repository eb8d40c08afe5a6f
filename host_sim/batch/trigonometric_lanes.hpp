/// Sine and cosine of one angle in lanes. Compiled once for each instruction set.
#if defined(SONOGLIDE_BATCH_TRIGONOMETRIC_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_TRIGONOMETRIC_LANES
#undef SONOGLIDE_BATCH_TRIGONOMETRIC_LANES
#else
#define SONOGLIDE_BATCH_TRIGONOMETRIC_LANES
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "firmware/numeric/turn.hpp"
#include "host_sim/batch/factorials.hpp"
#include "host_sim/batch/lane_pack.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Vector>
struct SineAndCosine {
  Vector sine;
  Vector cosine;
};

/// r^First / First! - r^(First + 2) / (First + 2)! + ... up to the power Last, over r^First.
template <int First, int Last, class D>
HWY_INLINE hn::Vec<D> alternating_series(D d, hn::Vec<D> square) {
  using Scalar = hn::TFromD<D>;
  const auto coefficient = [&](int power) {
    const double size = reciprocal_factorials[static_cast<std::size_t>(power)];
    return hn::Set(d, static_cast<Scalar>((power - First) % 4 == 0 ? size : -size));
  };
  auto sum = coefficient(Last);
  HWY_UNROLL(16)
  for (int power = Last - 2; power >= First; power -= 2) {
    sum = fused(sum, square, coefficient(power));
  }
  return sum;
}

/// Both from one reduction to |r| <= pi/4. Absolute error 3e-14 (double), 3e-7 (float) for
/// |x| <= 10.
template <class D>
HWY_INLINE SineAndCosine<hn::Vec<D>> sine_and_cosine(D d, hn::Vec<D> x) {
  using Scalar = hn::TFromD<D>;
  constexpr bool narrow = sizeof(Scalar) == sizeof(float);
  const hn::RebindToUnsigned<D> integers;
  using Bits = hn::TFromD<decltype(integers)>;
  // Adding it rounds to an integer, which the lowest bits then hold.
  const auto rounder = hn::Set(d, narrow ? Scalar(0x1.8p23) : Scalar(0x1.8p52));
  constexpr double quarter_turn = 0.5 * numeric::half_turn;
  const auto shifted = fused(x, hn::Set(d, static_cast<Scalar>(1.0 / quarter_turn)), rounder);
  const auto r =
      fused_negative(hn::Sub(shifted, rounder), hn::Set(d, static_cast<Scalar>(quarter_turn)), x);
  const auto square = hn::Mul(r, r);
  constexpr int last_of_sine = narrow ? 9 : 13;
  constexpr int last_of_cosine = narrow ? 8 : 14;
  const auto sine = hn::Mul(r, alternating_series<1, last_of_sine>(d, square));
  const auto cosine = alternating_series<0, last_of_cosine>(d, square);

  const auto quadrant = hn::BitCast(integers, shifted);
  const auto one = hn::Set(integers, Bits{1});
  const auto is_odd = hn::RebindMask(d, hn::TestBit(quadrant, one));
  const auto second_bit_as_sign = [&](auto number) {
    const auto second_bit = hn::And(number, hn::Set(integers, Bits{2}));
    return hn::BitCast(d, hn::ShiftLeft < narrow ? 30 : 62 > (second_bit));
  };
  return {
      hn::Xor(hn::IfThenElse(is_odd, cosine, sine), second_bit_as_sign(quadrant)),
      hn::Xor(hn::IfThenElse(is_odd, sine, cosine), second_bit_as_sign(hn::Add(quadrant, one)))};
}

template <class D>
HWY_INLINE SineAndCosine<Pack<D>> sine_and_cosine(D d, Pack<D> x) {
  const auto first = sine_and_cosine(d, x.first);
  const auto second = sine_and_cosine(d, x.second);
  return {{first.sine, second.sine}, {first.cosine, second.cosine}};
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
