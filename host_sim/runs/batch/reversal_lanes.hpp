/// The first reversal of the sliding velocity within a step, in each lane. Compiled once for each
/// instruction set.
#if defined(SONOGLIDE_BATCH_REVERSAL_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_REVERSAL_LANES
#undef SONOGLIDE_BATCH_REVERSAL_LANES
#else
#define SONOGLIDE_BATCH_REVERSAL_LANES
#endif

#include <hwy/highway.h>

#include "host_sim/runs/batch/lane_pack.hpp"
#include "host_sim/runs/batch/series_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Bounds of |V''| and |V'''| over a step, in units of the series.
///
/// |v| + sqrt(k) |y| and |v'| + sqrt(k) |v| grow no faster than the forces, and their rates, drive
/// them: damping only takes away.
template <class D>
struct CurvatureBound {
  using V = Pack<D>;

  V second;
  V third;

  template <class Drive>
  HWY_INLINE CurvatureBound(D d, const PlantLanes<D>& plant, const MotionLanes<D>& motion,
                            const InstantLanes<D, Drive>& instant, V extent) {
    const V length = extent * instant.unit;
    const V drive = Drive::bound(plant);
    const V speed = Abs(motion.velocity);
    const V velocity = MulAdd(drive + plant.friction_force, length,
                              MulAdd(plant.natural_frequency, Abs(motion.displacement), speed));
    const V sliding = Abs(plant.sliding_velocity) + velocity;
    const V relaxation = plant.contact_stiffness * instant.deficit;
    const V friction = plant.friction_force * relaxation;
    const V friction_rate = friction * sliding;
    const V acceleration =
        MulAdd(drive + friction_rate, length,
               MulAdd(plant.natural_frequency, speed, Abs(instant.acceleration)));
    const V spring_rate = Min(plant.stiffness * velocity, plant.natural_frequency * acceleration);
    const V jerk = drive + MulAdd(plant.damping, acceleration, spring_rate) + friction_rate;
    const V bend = MulAdd(plant.contact_stiffness * sliding, sliding, acceleration);
    const V snap =
        MulAdd(plant.stiffness, acceleration, drive) + MulAdd(plant.damping, jerk, friction * bend);
    const V unit_squared = instant.unit * instant.unit;
    // A little more than rounding can take away.
    const V margin = broadcast(d, hn::TFromD<D>(1.001)) * unit_squared;
    second = margin * jerk;
    third = margin * instant.unit * snap;
  }
};

/// Finds the first zero of p = s V in (0, extent], p >= 0 at 0.
///
/// p is sampled; the sample of the other sign brackets the zero, a secant and a few corrections of
/// Halley refine it. Both are certified by a bound of the curvature: that no pair of zeros lies
/// between samples of one sign, and that no other zero precedes the one found. A lane where the
/// bound does not suffice, as it may near a grazing zero, is left to the caller.
template <class D, int Order, int Samples, int Corrections>
class ReversalLanes {
 public:
  using V = Pack<D>;
  using M = Choice<D>;

  M reverses;   ///< root is one
  M uncertain;  ///< nothing is known for certain
  V root;       ///< extent where there is none

  template <class Drive>
  HWY_INLINE ReversalLanes(D d, const InstantLanes<D, Drive>& instant,
                           const SeriesLanes<D, Order>& series, V vibration_sign,
                           const CurvatureBound<D>& bound, V extent)
      : series_(series),
        start_(Abs(instant.contact_velocity)),
        orientation_(instant.direction * vibration_sign),
        spacing_(extent * broadcast(d, Scalar(1) / Samples)) {
    const V zero = zeros(d);
    from_rest_ = instant.contact_velocity == zero;
    scan(d, bound);
    root = extent;
    if (AllFalse(d, reverses)) {
      return;
    }
    Jet p = {};
    V change = zero;
    V x = Clamp(secant(), low_, low_ + spacing_);
    HWY_UNROLL(1)
    for (int pass = 0; pass < Corrections; ++pass) {
      p = jet(d, x);
      const V step = correction(p);
      change = Abs(step);  // not what the bracket leaves of it
      x = Clamp(x + step, low_, low_ + spacing_);
    }
    const M settled = And(change <= broadcast(d, root_tolerance) * x,
                          change * bound.second <= broadcast(d, straightness) * Abs(p.slope));
    const M found = And(settled, is_first(d, x, p.slope, change, bound));
    uncertain = Or(uncertain, AndNot(found, reverses));
    root = IfThenElse(reverses, x, extent);
  }

 private:
  using Scalar = hn::TFromD<D>;
  /// Largest last correction, relative to the root and to the distance on which p is nearly
  /// straight: what is left after it is smaller by the square of the latter.
  static constexpr Scalar root_tolerance =
      sizeof(Scalar) == sizeof(float) ? Scalar(1e-2) : Scalar(1e-4);
  static constexpr Scalar straightness = Scalar(0.01);

  /// (p(x) - p(0)) / x.
  HWY_INLINE V slope_from_start(V x) const {
    V value = series_.velocity[Order];
    HWY_UNROLL(32)
    for (int n = Order - 1; n >= 1; --n) {
      value = MulAdd(value, x, series_.velocity[n]);
    }
    return orientation_ * value;
  }

  HWY_INLINE void scan(D d, const CurvatureBound<D>& bound) {
    const V zero = zeros(d);
    const V sag = bound.second * spacing_ * spacing_ * broadcast(d, Scalar(0.5));
    const V initial_slope = orientation_ * series_.velocity[1];
    const V slope_spread = bound.second * spacing_ * broadcast(d, Scalar(0.5));
    low_ = zero;
    low_value_ = start_;
    high_value_ = start_;
    const M none = zero < zero;
    M searching = Not(none);
    reverses = none;
    uncertain = none;
    V x = zero;
    V before = start_;
    HWY_UNROLL(1)
    for (int j = 1; j <= Samples; ++j) {
      const V end = broadcast(d, static_cast<Scalar>(j)) * spacing_;
      const V slope = slope_from_start(end);
      const V value = MulAdd(end, slope, start_);
      M clear = stays_above(d, before, value, sag);
      if (j == 1) {
        clear = Or(clear, initial_slope + slope > slope_spread);
      }
      const M hit = AndNot(value > zero, searching);
      low_ = IfThenElse(hit, x, low_);
      low_value_ = IfThenElse(hit, before, low_value_);
      high_value_ = IfThenElse(hit, value, high_value_);
      reverses = Or(reverses, hit);
      searching = AndNot(hit, searching);
      uncertain = Or(uncertain, AndNot(clear, searching));
      x = end;
      before = value;
    }
    from_start_ = And(from_rest_, low_ == zero);
  }

  /// Whether a parabola with these values > 0 at the ends of an interval has no zero in it; the
  /// sag is its curvature times half the square of the interval.
  static HWY_INLINE M stays_above(D d, V first, V last, V sag) {
    const V excess = sag - (first + last);
    const V product = broadcast(d, Scalar(4)) * first * last;
    const M is_nearly_straight = excess < zeros(d);
    return Or(is_nearly_straight, product > excess * excess);
  }

  /// From rest the zero at the beginning is divided out.
  HWY_INLINE V secant() const {
    const V initial_rise = orientation_ * series_.velocity[1] * spacing_;
    const V low_value = IfThenElse(from_start_, initial_rise, low_value_);
    return low_ + spacing_ * (low_value / (low_value - high_value_));
  }

  /// Of p at a place, and of what has the zero sought: p or, from rest, p / x.
  struct Jet {
    V slope;
    V sought;
    V sought_slope;
    V sought_half_curvature;
  };

  HWY_INLINE Jet jet(D d, V x) const {
    V value = series_.velocity[Order];
    V slope = zeros(d);
    V half_curvature = zeros(d);
    HWY_UNROLL(32)
    for (int n = Order - 1; n >= 1; --n) {
      half_curvature = MulAdd(half_curvature, x, slope);
      slope = MulAdd(slope, x, value);
      value = MulAdd(value, x, series_.velocity[n]);
    }
    const V p = MulAdd(orientation_ * x, value, start_);
    const V p_slope = MulAdd(x, slope, value);
    const V p_half_curvature = MulAdd(x, half_curvature, slope);
    return {orientation_ * p_slope, IfThenElse(from_rest_, orientation_ * value, p),
            orientation_ * IfThenElse(from_rest_, slope, p_slope),
            orientation_ * IfThenElse(from_rest_, half_curvature, p_half_curvature)};
  }

  /// Halley's.
  static HWY_INLINE V correction(const Jet& p) {
    const V divisor = NegMulAdd(p.sought, p.sought_half_curvature, p.sought_slope * p.sought_slope);
    return Neg(p.sought * p.sought_slope / divisor);
  }

  /// No zero between the sample before it and the one at x. Divided by its known zeros, p keeps one
  /// sign: a divided difference varies no faster than the next derivative allows. The slope is that
  /// of a point `change` away.
  HWY_INLINE M is_first(D d, V x, V slope, V change, const CurvatureBound<D>& bound) const {
    const V half = broadcast(d, Scalar(0.5));
    const V sixth = broadcast(d, Scalar(1.0 / 6.0));
    const V width = x - low_;
    const V spread = bound.second * change;
    const V steepest = MulAdd(bound.second * half, width, slope + spread);
    const M alone = low_value_ > width * steepest;
    const V arch = orientation_ * series_.velocity[1] - slope - spread;
    const M alone_after_rest = arch > bound.third * x * x * sixth;
    return Or(AndNot(from_start_, alone), And(from_start_, alone_after_rest));
  }

  const SeriesLanes<D, Order>& series_;
  V start_;
  V orientation_;
  V spacing_;
  M from_rest_;
  M from_start_;  ///< the bracket begins at a zero that is not the one sought
  V low_;
  V low_value_;
  V high_value_;
};

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
