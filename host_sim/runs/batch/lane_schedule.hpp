/// Which plant runs in which lane. Compiled once for each instruction set.
#if defined(SONOGLIDE_BATCH_LANE_SCHEDULE) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_LANE_SCHEDULE
#undef SONOGLIDE_BATCH_LANE_SCHEDULE
#else
#define SONOGLIDE_BATCH_LANE_SCHEDULE
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "host_sim/runs/batch/advance_lanes.hpp"
#include "host_sim/runs/batch/lane_pack.hpp"
#include "host_sim/runs/batch/lane_queue.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Runs the plants of a queue to their end. A lane is given the next one as soon as it is free, and
/// what it does depends on its own plant alone.
template <class Setting>
class LaneSchedule {
 public:
  explicit LaneSchedule(LaneQueue& queue) : queue_(queue) {}

  void run() {
    const D d;
    for (std::size_t lane = 0; lane < pack_lanes(d); ++lane) {
      load(lane, queue_.next(lane));
    }
    while (queue_.busy()) {
      const StepLanes<D, Setting> step(d, plant_, motion_);
      const M due = Or(ended(), step.undecided);
      if (HWY_UNLIKELY(!AllFalse(d, due))) {
        attend(due, step.undecided);
      }
    }
  }

 private:
  using Scalar = typename Setting::Scalar;
  using D = hn::ScalableTag<Scalar>;
  using V = Pack<D>;
  using M = Choice<D>;

  HWY_INLINE M ended() const {
    const D d;
    const V size = Abs(motion_.displacement) + Abs(motion_.velocity);
    const M strayed = Not(size < broadcast(d, static_cast<Scalar>(farthest)));
    const M tired = motion_.steps_left <= zeros(d);
    return Or(motion_.periods_left <= zeros(d), Or(strayed, tired));
  }

  HWY_NOINLINE void attend(M due, M undecided) {
    const D d;
    const V is_due = indicator(d, due);
    const V is_undecided = indicator(d, undecided);
    for (std::size_t lane = 0; lane < pack_lanes(d); ++lane) {
      if (lane_of(is_due, lane) == Scalar(0)) {
        continue;
      }
      const bool decided = lane_of(is_undecided, lane) == Scalar(0);
      if (decided && queue_.goes_on(lane, progress(lane))) {
        begin_stretch(lane, queue_.stretch(lane));
      } else {
        load(lane, decided ? queue_.next(lane) : queue_.give_up(lane));
      }
    }
  }

  Progress progress(std::size_t lane) const {
    return {{value(motion_.displacement, lane), value(motion_.velocity, lane),
             value(motion_.friction, lane)},
            {value(motion_.friction_integral, lane), value(motion_.friction_work, lane)},
            value(motion_.periods_left, lane)};
  }

  void load(std::size_t lane, const LanePlant& next) {
    const DahlPlant& plant = next.plant;
    set(plant_.damping, lane, plant.damping);
    set(plant_.stiffness, lane, plant.stiffness);
    set(plant_.friction_force, lane, plant.friction_force);
    set(plant_.contact_stiffness, lane, plant.contact_stiffness);
    set(plant_.sliding_velocity, lane, plant.sliding_velocity);
    set(plant_.vibration_sign, lane, plant.vibration_sign);
    set(plant_.natural_frequency, lane, next.natural_frequency);
    set(plant_.own_rate, lane, next.own_rate);
    set(motion_.displacement, lane, plant.initial.displacement);
    set(motion_.velocity, lane, plant.initial.velocity);
    set(motion_.friction, lane, plant.initial.friction);
    begin_stretch(lane, queue_.stretch(lane));
  }

  void begin_stretch(std::size_t lane, const LaneStretch& stretch) {
    set(plant_.drive_amplitude, lane, stretch.drive.at_zero);
    if constexpr (Setting::ramped) {
      set(plant_.drive_slope, lane, stretch.drive.slope);
      set(plant_.drive_bound, lane, bound_of(stretch.drive));
    }
    set(motion_.phase, lane, 0.0);
    set(motion_.periods_left, lane, stretch.periods);
    set(motion_.steps_left, lane, stretch.periods * most_steps_per_period);
    set(motion_.friction_integral, lane, 0.0);
    set(motion_.friction_work, lane, 0.0);
  }

  static double value(const V& v, std::size_t lane) {
    return static_cast<double>(lane_of(v, lane));
  }
  static void set(V& v, std::size_t lane, double value) {
    set_lane(v, lane, static_cast<Scalar>(value));
  }

  LaneQueue& queue_;
  PlantLanes<D> plant_ = {};
  MotionLanes<D> motion_ = {};
};

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
