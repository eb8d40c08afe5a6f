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
#include "host_sim/runs/batch/elementary_lanes.hpp"
#include "host_sim/runs/batch/lane_pack.hpp"

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
  // Where the setting is ramped:
  V drive_slope;  ///< increase of a with the phase, which then is that of phase 0
  V drive_bound;  ///< of the force and its first two derivatives within a period
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

/// Terms of the power series of a cosine, in two places in turn.
template <class D>
struct CosineTerms {
  Pack<D> term[2];

  template <int N>
  HWY_INLINE Pack<D> at() const {
    return term[N % 2];
  }
  /// The place of the one before the N-th becomes that of the one after it.
  template <int N>
  HWY_INLINE void pass(D d, Pack<D> unit_squared) {
    if constexpr (N > 0) {
      const Pack<D> next = term[(N + 1) % 2] * unit_squared;
      term[(N + 1) % 2] = Neg(next * (reciprocal(d, N + 1) * reciprocal(d, N)));
    }
  }
};

/// The amplitude of the drive holds.
template <class D>
struct HeldDrive {
  using V = Pack<D>;

  HWY_INLINE HeldDrive(const PlantLanes<D>& /*plant*/, const SineAndCosine<V>& /*turn*/) {}
  HWY_INLINE V amplitude(const PlantLanes<D>& plant, V /*phase*/) const {
    return plant.drive_amplitude;
  }
  /// Of the force and its first two derivatives.
  static HWY_INLINE V bound(const PlantLanes<D>& plant) { return Abs(plant.drive_amplitude); }
  HWY_INLINE CosineTerms<D> series(V first, V second, V /*unit*/, V /*unit_squared*/) const {
    return {{first, second}};
  }
};

/// It is linear in the phase: beside the cosine there is slope t cos(tau).
template <class D>
struct RampedDrive {
  using V = Pack<D>;

  V in_phase;    ///< (da/dtau) cos(tau)
  V quadrature;  ///< (da/dtau) sin(tau)

  HWY_INLINE RampedDrive(const PlantLanes<D>& plant, const SineAndCosine<V>& turn)
      : in_phase(plant.drive_slope * turn.cosine), quadrature(plant.drive_slope * turn.sine) {}
  HWY_INLINE V amplitude(const PlantLanes<D>& plant, V phase) const {
    return MulAdd(plant.drive_slope, phase, plant.drive_amplitude);
  }

  static HWY_INLINE V bound(const PlantLanes<D>& plant) { return plant.drive_bound; }

  struct Terms {
    CosineTerms<D> level;
    CosineTerms<D> slope;

    template <int N>
    HWY_INLINE V at() const {
      return level.template at<N>() + slope.template at<N - 1>();
    }
    template <int N>
    HWY_INLINE void pass(D d, V unit_squared) {
      level.template pass<N>(d, unit_squared);
      slope.template pass<N - 1>(d, unit_squared);
    }
  };
  HWY_INLINE Terms series(V first, V second, V unit, V unit_squared) const {
    return {{{first, second}},
            {{in_phase * unit_squared, Neg(quadrature * (unit_squared * unit))}}};
  }
};

/// The motion where the step begins, and the direction in which the contact slides.
template <class D, class Drive>
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
  Drive drive;

  HWY_INLINE InstantLanes(D d, const PlantLanes<D>& plant, const MotionLanes<D>& motion,
                          V negligible_deficit)
      : InstantLanes(d, plant, motion, negligible_deficit, sine_and_cosine(d, motion.phase)) {}

 private:
  HWY_INLINE InstantLanes(D d, const PlantLanes<D>& plant, const MotionLanes<D>& motion,
                          V negligible_deficit, const SineAndCosine<V>& turn)
      : drive(plant, turn) {
    const V one = broadcast(d, 1);
    const V amplitude = drive.amplitude(plant, motion.phase);
    in_phase = amplitude * turn.cosine;
    quadrature = amplitude * turn.sine;
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

  template <class Drive>
  HWY_INLINE SeriesLanes(D d, const PlantLanes<D>& plant, const MotionLanes<D>& motion,
                         const InstantLanes<D, Drive>& instant) {
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
    auto drive =
        instant.drive.series(instant.in_phase * instant.unit,
                             Neg(instant.quadrature * unit_squared), instant.unit, unit_squared);
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
  template <class Drive, int... Terms>
  HWY_INLINE void add_terms(D d, const Recurrence& recurrence, Drive& drive,
                            std::integer_sequence<int, Terms...> /*terms*/) {
    (add_term<Terms + 1>(d, recurrence, drive), ...);
  }

  /// Terms of x^(N + 1) from those before.
  template <int N, class Drive>
  HWY_INLINE void add_term(D d, const Recurrence& recurrence, Drive& drive) {
    const V factor = reciprocal(d, N + 1);
    relaxation_[N] = recurrence.vibration * velocity[N];
    displacement[N + 1] = factor * velocity[N];
    V force = NegMulAdd(recurrence.stiffness, displacement[N], drive.template at<N>());
    force = NegMulAdd(recurrence.damping, velocity[N], force);
    force = MulAdd(recurrence.friction, deficit[N], force);
    velocity[N + 1] = factor * force;
    deficit[N + 1] = factor * convolution(std::make_integer_sequence<int, (N + 1) / 2>(), N);
    drive.template pass<N>(d, recurrence.unit_squared);
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
