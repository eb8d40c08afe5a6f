/// The plant in each lane, and the power series of its motion. Compiled once for each instruction set.
#if defined(SONOGLIDE_BATCH_SERIES_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_SERIES_LANES
#undef SONOGLIDE_BATCH_SERIES_LANES
#else
#define SONOGLIDE_BATCH_SERIES_LANES
#endif

#include <hwy/highway.h>

#include <utility>

#include "firmware/numeric/power_series.hpp"
#include "host_sim/batch/elementary_lanes.hpp"
#include "host_sim/batch/lane_pack.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Symbols as in batch::DahlPlant.
template <class D>
struct PlantLanes {
  using V = Pack<D>;

  V drive_amplitude;    ///< a
  V damping;            ///< d
  V stiffness;          ///< k
  V friction_force;     ///< beta
  V contact_stiffness;  ///< kappa
  V sliding_velocity;   ///< r
  V vibration_sign;     ///< sigma
  V natural_frequency;  ///< sqrt(k)
  V own_rate;           ///< the fastest that the plant moves by itself, of the order of 1 at least
};

template <class D>
struct MotionLanes {
  using V = Pack<D>;

  V phase;         ///< tau since the last whole period, [0, 2 pi)
  V periods_left;  ///< until the lane is to be looked at, the running one included; 0: it is due
  V steps_left;    ///< until the lane is to be looked at in any case
  V displacement;
  V velocity;
  V friction;
  V friction_integral;  ///< of phi, since the lane was looked at last
  V friction_work;      ///< integral of phi V, likewise
};

/// 1 / n in every lane.
template <class D>
HWY_INLINE Pack<D> reciprocal(D d, int n) {
  return broadcast(d, numeric::reciprocal<hn::TFromD<D>>(static_cast<std::size_t>(n)));
}

/// The motion where the step begins, and the direction in which the contact slides.
template <class D>
struct InstantLanes {
  using V = Pack<D>;

  V in_phase;          ///< a cos(tau)
  V quadrature;        ///< a sin(tau)
  V acceleration;      ///< y''
  V contact_velocity;  ///< V
  V direction;         ///< s = sgn V; where V = 0, that of its derivative
  V deficit;           ///< e = 1 - s phi
  V resolved_deficit;  ///< the same, or 0 where it is too small to matter within the step
  V rate;              ///< no slower than anything that moves
  V unit;              ///< of the power series, in tau: 1 / rate

  HWY_INLINE InstantLanes(D d, const PlantLanes<D>& plant, const MotionLanes<D>& motion,
                          V negligible_deficit) {
    const V one = broadcast(d, 1);
    const SineAndCosine<V> turn = sine_and_cosine(d, motion.phase);
    in_phase = plant.drive_amplitude * turn.cosine;
    quadrature = plant.drive_amplitude * turn.sine;
    acceleration = NegMulAdd(plant.friction_force, motion.friction,
                             NegMulAdd(plant.stiffness, motion.displacement,
                                       NegMulAdd(plant.damping, motion.velocity, in_phase)));
    contact_velocity = MulAdd(plant.vibration_sign, motion.velocity, plant.sliding_velocity);
    const V leading = IfThenElse(contact_velocity == zeros(d), plant.vibration_sign * acceleration,
                                 contact_velocity);
    direction = CopySign(one, leading);
    deficit = NegMulAdd(direction, motion.friction, one);
    const auto relaxes = deficit > negligible_deficit;
    resolved_deficit = IfThenElseZero(relaxes, deficit);
    const V stiffness = IfThenElseZero(relaxes, plant.contact_stiffness);
    const V relaxation =
        MulAdd(stiffness, Abs(contact_velocity), Sqrt(stiffness * Abs(acceleration)));
    rate = plant.own_rate + relaxation;
    unit = one / rate;
  }
};

/// Taylor coefficients in x = (tau - tau0) / unit, up to x^Order.
template <class D, int Order>
struct SeriesLanes {
  using V = Pack<D>;

  V velocity[Order + 1];
  V displacement[Order + 1];  ///< in units of `unit`
  V deficit[Order + 1];       ///< e, as far as it is resolved

  HWY_INLINE SeriesLanes(D d, const PlantLanes<D>& plant, const MotionLanes<D>& motion,
                         const InstantLanes<D>& instant) {
    const V unit_squared = instant.unit * instant.unit;
    const V damping = plant.damping * instant.unit;
    const V stiffness = plant.stiffness * unit_squared;
    const V friction = plant.friction_force * instant.unit * instant.direction;
    const V decay = Neg(plant.contact_stiffness * instant.unit * instant.direction);
    velocity[0] = motion.velocity;
    displacement[0] = motion.displacement * instant.rate;
    deficit[0] = instant.resolved_deficit;
    velocity[1] = instant.acceleration * instant.unit;
    displacement[1] = velocity[0];
    relaxation_[0] = decay * instant.contact_velocity;
    deficit[1] = relaxation_[0] * deficit[0];
    const Recurrence recurrence = {decay * plant.vibration_sign, damping, stiffness, friction,
                                   unit_squared};
    V drive[2] = {instant.in_phase * instant.unit, Neg(instant.quadrature * unit_squared)};
    add_terms(d, recurrence, drive, std::make_integer_sequence<int, Order - 1>());
  }

 private:
  struct Recurrence {
    V vibration;
    V damping;
    V stiffness;
    V friction;
    V unit_squared;
  };

  /// Unrolled: the sums are short, of known length, and overlap.
  template <int... Terms>
  HWY_INLINE void add_terms(D d, const Recurrence& recurrence, V* drive,
                            std::integer_sequence<int, Terms...> /*terms*/) {
    (add_term<Terms + 1>(d, recurrence, drive), ...);
  }

  /// Terms of x^(N + 1) from those before. The drive's terms alternate between two places.
  template <int N>
  HWY_INLINE void add_term(D d, const Recurrence& recurrence, V* drive) {
    const V factor = reciprocal(d, N + 1);
    relaxation_[N] = recurrence.vibration * velocity[N];
    displacement[N + 1] = factor * velocity[N];
    V force = NegMulAdd(recurrence.stiffness, displacement[N], drive[N % 2]);
    force = NegMulAdd(recurrence.damping, velocity[N], force);
    force = MulAdd(recurrence.friction, deficit[N], force);
    velocity[N + 1] = factor * force;
    deficit[N + 1] = factor * convolution(std::make_integer_sequence<int, (N + 1) / 2>(), N);
    const V next_drive = drive[(N + 1) % 2] * recurrence.unit_squared;
    drive[(N + 1) % 2] = Neg(next_drive * (factor * reciprocal(d, N)));
  }

  /// Sum of relaxation[j] deficit[n - j], from the middle outwards: the newest factors enter last,
  /// the rest need not wait for them.
  template <int... Pairs>
  HWY_INLINE V convolution(std::integer_sequence<int, Pairs...> /*pairs*/, int n) const {
    constexpr int last = static_cast<int>(sizeof...(Pairs)) - 1;
    const int middle = n / 2;
    V sum = n % 2 == 0 ? relaxation_[middle] * deficit[middle] : zeros(D());
    ((sum = MulAdd(relaxation_[last - Pairs], deficit[n - last + Pairs], sum),
      sum = MulAdd(relaxation_[n - last + Pairs], deficit[last - Pairs], sum)),
     ...);
    return sum;
  }

  V relaxation_[Order];  ///< -kappa s V
};

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
