/// A plant in each lane: parameters, state and integrals. Compiled once for each instruction set.
#if defined(SONOGLIDE_BATCH_PLANT_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_PLANT_LANES
#undef SONOGLIDE_BATCH_PLANT_LANES
#else
#define SONOGLIDE_BATCH_PLANT_LANES
#endif

#include <hwy/highway.h>

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

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
