/// One step of the event-located Taylor method in every lane. Compiled once for each instruction
/// set.
#if defined(SONOGLIDE_BATCH_ADVANCE_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_ADVANCE_LANES
#undef SONOGLIDE_BATCH_ADVANCE_LANES
#else
#define SONOGLIDE_BATCH_ADVANCE_LANES
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "firmware/numeric/first_root.hpp"
#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/runs/batch/elementary_lanes.hpp"
#include "host_sim/runs/batch/lane_pack.hpp"
#include "host_sim/runs/batch/reversal_lanes.hpp"
#include "host_sim/runs/batch/series_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// In a single lane: the first zero of p = |V| within (0, end), certified, or `end`; p[0] >= 0, and
/// where it is zero that zero does not count. Not a number where the polynomial is not made of
/// finite ones.
template <class Scalar, std::size_t Count>
Scalar certain_reversal(std::array<Scalar, Count> p, Scalar end) {
  Scalar sum = end;
  for (const Scalar coefficient : p) {
    sum += numeric::abs(coefficient);
  }
  if (!numeric::is_finite(sum)) {
    return std::numeric_limits<Scalar>::quiet_NaN();
  }
  if (p[0] == Scalar(0)) {
    for (std::size_t n = 1; n < Count; ++n) {
      p[n - 1] = p[n];
    }
    p[Count - 1] = Scalar(0);
  }
  return numeric::first_root(p, end);
}

/// Each lane takes its own step: the longest whose last terms stay below the tolerance, shortened
/// to the first reversal of V and to the end of the lane's last period. Friction follows the
/// displacement exactly, so |phi| <= 1.
///
/// Setting:
///   Scalar                 of the lanes
///   order                  of the power series
///   reversal_samples       of V in a step, to find its reversals; fewer leave more to single lanes
///   root_corrections       of such a reversal
///   node_count             of the quadrature of the friction in a step
///   decay_degree           of its exponential
///   tolerance              of the last two terms of a step
///   least_friction_weight  of the friction in these terms
///   negligible_deficit     below which the friction counts as settled
///   longest_step           [rad], < 2 pi
///   counts_work            the friction work is integrated too
///   ramped                 the amplitude of the drive may be linear in its phase
template <class D, class Setting>
class StepLanes {
 public:
  using V = Pack<D>;
  using M = Choice<D>;

  M undecided;  ///< V = 0 and so is its derivative, within rounding: the lane did not move

  HWY_INLINE StepLanes(D d, const PlantLanes<D>& plant, MotionLanes<D>& motion)
      : plant_(plant),
        instant_(d, plant, motion, broadcast(d, Setting::negligible_deficit)),
        series_(d, plant, motion, instant_) {
    const V remaining = left_of_period(d, motion) * instant_.rate;
    const V longest = Min(tolerated(d), remaining);
    const CurvatureBound<D> bound(d, plant, motion, instant_, longest);
    const ReversalLanes<D, order, Setting::reversal_samples, Setting::root_corrections> reversal(
        d, instant_, series_, plant.vibration_sign, bound, longest);
    V extent = reversal.root;
    M reverses = reversal.reverses;
    undecided = at_rest_without_acceleration(d, motion);
    if (HWY_UNLIKELY(!AllFalse(d, reversal.uncertain))) {
      search_lane_by_lane(d, reversal.uncertain, longest, extent, reverses);
    }
    extent = IfThenZeroElse(undecided, extent);
    reverses = AndNot(undecided, reverses);
    accept(d, extent, reverses, AndNot(reverses, extent == remaining), motion);
  }

 private:
  using Scalar = typename Setting::Scalar;
  using Drive = std::conditional_t<Setting::ramped, RampedDrive<D>, HeldDrive<D>>;
  static constexpr int order = Setting::order;
  static constexpr Scalar two_pi = Scalar(numeric::two_pi);

  /// Only the last period ends a step; a lane that idles has none.
  HWY_INLINE V left_of_period(D d, const MotionLanes<D>& motion) const {
    const V rest = broadcast(d, two_pi) - motion.phase;
    return IfThenElse(motion.periods_left == broadcast(d, Scalar(1)), rest, broadcast(d, two_pi));
  }

  HWY_INLINE V tolerated(D d) const {
    const V rounding =
        broadcast(d, std::numeric_limits<Scalar>::epsilon()) * Abs(series_.velocity[0]);
    const V allowed = Max(broadcast(d, Setting::tolerance), rounding);
    const V last = magnitude(d, order);
    const V last_but_one = magnitude(d, order - 1);
    const V extent = Min(quick_root_of_quotient<order>(d, allowed, last),
                         quick_root_of_quotient<order - 1>(d, allowed, last_but_one));
    return Min(extent, broadcast(d, Setting::longest_step) * instant_.rate);
  }

  /// The deficit enters the velocity times beta alone; its own integral is not taken from the
  /// series.
  HWY_INLINE V magnitude(D d, int n) const {
    const V weight = Max(plant_.friction_force, broadcast(d, Setting::least_friction_weight));
    return MulAdd(weight, Abs(series_.deficit[n]), Abs(series_.velocity[n]));
  }

  HWY_INLINE M at_rest_without_acceleration(D d, const MotionLanes<D>& motion) const {
    const V forces = Abs(instant_.in_phase) + Abs(instant_.quadrature) +
                     Abs(plant_.damping * motion.velocity) +
                     Abs(plant_.stiffness * motion.displacement) + plant_.friction_force;
    const V rounding = broadcast(d, Scalar(64) * std::numeric_limits<Scalar>::epsilon()) * forces;
    return And(instant_.contact_velocity == zeros(d), Abs(instant_.acceleration) <= rounding);
  }

  /// Where lanes together cannot tell, each is searched alone.
  HWY_NOINLINE void search_lane_by_lane(D d, M uncertain, V longest, V& extent, M& reverses) const {
    const V is_uncertain = indicator(d, uncertain);
    const V orientation = instant_.direction * plant_.vibration_sign;
    V found = indicator(d, reverses);
    for (std::size_t lane = 0; lane < pack_lanes(d); ++lane) {
      if (lane_of(is_uncertain, lane) == Scalar(0)) {
        continue;
      }
      std::array<Scalar, order + 1> velocity{};
      velocity[0] = lane_of(Abs(instant_.contact_velocity), lane);
      for (std::size_t n = 1; n <= order; ++n) {
        velocity[n] = lane_of(orientation, lane) * lane_of(series_.velocity[n], lane);
      }
      const Scalar end = lane_of(longest, lane);
      const Scalar root = certain_reversal(velocity, end);
      set_lane(extent, lane, root);
      set_lane(found, lane, root < end ? Scalar(1) : Scalar(0));
    }
    reverses = found > zeros(d);
  }

  HWY_INLINE void accept(D d, V extent, M reverses, M last, MotionLanes<D>& motion) const {
    const V one = broadcast(d, Scalar(1));
    const V length = extent * instant_.unit;
    V velocity = series_.velocity[order];
    V displacement = series_.displacement[order];
    HWY_UNROLL(32)
    for (int n = order - 1; n >= 1; --n) {
      velocity = MulAdd(velocity, extent, series_.velocity[n]);
      displacement = MulAdd(displacement, extent, series_.displacement[n]);
    }
    const V moved = displacement * length;
    const V resting = Neg(plant_.vibration_sign * plant_.sliding_velocity);
    motion.velocity = IfThenElse(reverses, resting, MulAdd(velocity, extent, motion.velocity));
    motion.displacement = motion.displacement + moved;
    motion.friction_integral =
        MulAdd(instant_.direction, length - deficit_integral(d, extent), motion.friction_integral);

    const V slid = travelled(d, extent, displacement);
    const V relaxed = instant_.deficit * settled(d, plant_.contact_stiffness * slid);
    if constexpr (Setting::counts_work) {
      motion.friction_work = motion.friction_work + (slid - relaxed / plant_.contact_stiffness);
    }
    motion.friction = Clamp(MulAdd(instant_.direction, relaxed, motion.friction), Neg(one), one);

    const V phase = motion.phase + length;
    const M wraps = Or(last, phase >= broadcast(d, two_pi));
    motion.phase = IfThenZeroElse(last, IfThenElse(wraps, phase - broadcast(d, two_pi), phase));
    motion.periods_left = motion.periods_left - IfThenElseZero(wraps, one);
    motion.steps_left = motion.steps_left - one;
  }

  /// 1 - exp(-z). The work needs the digits of a small one, the friction its error alone.
  static HWY_INLINE V settled(D d, V z) {
    if constexpr (Setting::counts_work) {
      return Neg(Expm1(d, Neg(z)));
    }
    return broadcast(d, Scalar(1)) - decay<9>(d, z);
  }

  /// Distance that the contact has slid at x, from (y(x) - y(0)) / x: an increment, for a
  /// difference of two displacements would cancel, and never backwards.
  HWY_INLINE V travelled(D d, V x, V slope) const {
    const V speed =
        instant_.direction * MulAdd(plant_.vibration_sign, slope, plant_.sliding_velocity);
    return Max(zeros(d), speed * (x * instant_.unit));
  }

  /// Gauss-Legendre, on the exact decay in displacement: good for steps on which the power series
  /// of the decay no longer is.
  HWY_INLINE V deficit_integral(D d, V extent) const {
    V sum = zeros(d);
    HWY_UNROLL(1)
    for (std::size_t node = 0; node < rule.node.size(); ++node) {
      const V x = extent * broadcast(d, static_cast<Scalar>(rule.node[node]));
      V slope = series_.displacement[order];
      HWY_UNROLL(32)
      for (int n = order - 1; n >= 1; --n) {
        slope = MulAdd(slope, x, series_.displacement[n]);
      }
      const V decayed =
          decay<Setting::decay_degree>(d, plant_.contact_stiffness * travelled(d, x, slope));
      sum = MulAdd(broadcast(d, static_cast<Scalar>(rule.weight[node])), decayed, sum);
    }
    return instant_.deficit * extent * instant_.unit * sum;
  }

  static constexpr auto rule = numeric::gauss_legendre<Setting::node_count>();

  const PlantLanes<D>& plant_;
  InstantLanes<D, Drive> instant_;
  SeriesLanes<D, order> series_;
};

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
