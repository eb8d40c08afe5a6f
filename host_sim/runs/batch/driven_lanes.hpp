/// The setting of order and step control of plants whose drive is set in each period. Compiled once
/// for each instruction set.
#if defined(SONOGLIDE_BATCH_DRIVEN_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_DRIVEN_LANES
#undef SONOGLIDE_BATCH_DRIVEN_LANES
#else
#define SONOGLIDE_BATCH_DRIVEN_LANES
#endif

#include <hwy/highway.h>

#include "host_sim/runs/batch/lane_schedule.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {

/// Good for 1e-6 of the mean friction of one period.
template <bool Ramped>
struct PeriodSetting {
  using Scalar = double;
  static constexpr int order = 10;
  static constexpr int reversal_samples = 2;
  static constexpr int root_corrections = 2;
  static constexpr int node_count = 4;
  static constexpr int decay_degree = 6;
  static constexpr double least_friction_weight = 1e-3;
  static constexpr double tolerance = 5e-7;
  static constexpr double negligible_deficit = 1e-8;
  static constexpr double longest_step = 3.0;
  static constexpr bool counts_work = false;
  static constexpr bool ramped = Ramped;
};

inline void run_driven(LaneQueue& queue) {
  LaneSchedule<PeriodSetting<false>>(queue).run();
}

inline void run_ramped(LaneQueue& queue) {
  LaneSchedule<PeriodSetting<true>>(queue).run();
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
