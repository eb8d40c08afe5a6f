/// One arc of a sinusoidal sliding velocity, from reversal to reversal, in each lane. Compiled once
/// for each instruction set.
#if defined(SONOGLIDE_BATCH_ARC_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_ARC_LANES
#undef SONOGLIDE_BATCH_ARC_LANES
#else
#define SONOGLIDE_BATCH_ARC_LANES
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>

#include "firmware/friction/gauss_legendre.hpp"
#include "host_sim/batch/decay_lanes.hpp"
#include "host_sim/batch/factorials.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr int arc_series_terms = 12;

/// Of sin (first 1) and cos (first 0) up to π/2, within 1e-16.
constexpr std::array<double, std::size_t{arc_series_terms}> alternating_series(std::size_t first) {
  std::array<double, std::size_t{arc_series_terms}> terms{};
  for (std::size_t n = 0; n < terms.size(); ++n) {
    terms[n] = (n % 2 == 0 ? 1.0 : -1.0) * reciprocal_factorials[2 * n + first];
  }
  return terms;
}
inline constexpr auto sine_series = alternating_series(1);
inline constexpr auto cosine_series = alternating_series(0);

/// V / v̂ = r + cos θ on either side of the reversal at θ* = arccos(−r), 0 <= r < 1. With x the
/// phase since the reversal,
///   travel(x) = √(1−r²) (1 − cos x) + d (x − sin x),
/// d = r on the forward arc, of length 2 θ*, and −r on the backward one, of length 2π − 2 θ*.
template <class D>
class ArcLanes {
 public:
  using V = hn::Vec<D>;

  HWY_INLINE ArcLanes(V sine, V drift, V arc_length)
      : length(arc_length), sine_(sine), drift_(drift) {}

  const V length;

  HWY_INLINE V travel(D d, V x) const {
    const V half = hn::Set(d, 0.5) * x;
    const auto past_middle = half > hn::Set(d, 0.5 * pi);
    const V angle = hn::IfThenElse(past_middle, hn::Set(d, pi) - half, half);
    const V square = angle * angle;
    V sine = hn::Zero(d);
    V cosine = hn::Zero(d);
    HWY_UNROLL(16)
    for (int n = arc_series_terms - 1; n >= 0; --n) {
      const auto term = static_cast<std::size_t>(n);
      sine = hn::MulAdd(sine, square, hn::Set(d, sine_series[term]));
      cosine = hn::MulAdd(cosine, square, hn::Set(d, cosine_series[term]));
    }
    sine = sine * angle;
    cosine = hn::IfThenElse(past_middle, hn::Neg(cosine), cosine);
    const V twice = sine + sine;
    return hn::MulAdd(sine_ * twice, sine, drift_ * hn::NegMulAdd(twice, cosine, x));
  }

  /// J = ∫ exp(−a travel) dθ over the arc, as far as it matters. The phase where it no longer does
  /// lies between `least` and `most` if it lies on the arc.
  HWY_INLINE V relaxation_integral(D d, V dahl_number, V least, V most) const {
    const V reach = effective_length(d, dahl_number, least, most);
    V sum = hn::Zero(d);
    HWY_UNROLL(4)
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const V exponent = dahl_number * travel(d, reach * hn::Set(d, rule.node[i]));
      sum = hn::MulAdd(hn::Set(d, rule.weight[i]),
                       decay<decay_degree>(d, hn::Max(exponent, hn::Zero(d))), sum);
    }
    return reach * sum;
  }

 private:
  static constexpr double pi = 3.14159265358979323846;
  static constexpr double negligible_exponent = 28.0;
  static constexpr int bisections = 6;
  static constexpr int decay_degree = 11;
  static constexpr auto rule = friction::gauss_legendre<24>();

  /// Phase beyond which exp(−a travel) is negligible, up to 4 % more, or the arc's length.
  HWY_INLINE V effective_length(D d, V dahl_number, V least, V most) const {
    const V threshold = hn::Set(d, negligible_exponent) / dahl_number;
    V low = least;
    V high = hn::Min(most, length);
    HWY_UNROLL(1)
    for (int pass = 0; pass < bisections; ++pass) {
      const V middle = hn::Set(d, 0.5) * (low + high);
      const auto short_of_it = hn::Lt(travel(d, middle), threshold);
      low = hn::IfThenElse(short_of_it, middle, low);
      high = hn::IfThenElse(short_of_it, high, middle);
    }
    return hn::Min(high, length);
  }

  V sine_;
  V drift_;
};

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
