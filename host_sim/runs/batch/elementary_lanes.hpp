/// Elementary functions that a step needs, in lanes: exponential, sine and cosine, a quick root.
/// Compiled once for each instruction set.
#if defined(SONOGLIDE_BATCH_ELEMENTARY_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_ELEMENTARY_LANES
#undef SONOGLIDE_BATCH_ELEMENTARY_LANES
#else
#define SONOGLIDE_BATCH_ELEMENTARY_LANES
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/numeric/turn.hpp"
#include "host_sim/runs/batch/lane_pack.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// 1 / n! for n in [0, 24].
inline constexpr std::array<double, 25> reciprocal_factorials = [] {
  std::array<double, 25> table{};
  double factorial = 1.0;
  for (std::size_t n = 0; n < table.size(); ++n) {
    factorial *= n == 0 ? 1.0 : static_cast<double>(n);
    table[n] = 1.0 / factorial;
  }
  return table;
}();

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
