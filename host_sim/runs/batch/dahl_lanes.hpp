/// The two settings of order and step control of runs under one drive. Compiled once for each instruction set.
#if defined(SONOGLIDE_BATCH_DAHL_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef SONOGLIDE_BATCH_DAHL_LANES
#undef SONOGLIDE_BATCH_DAHL_LANES
#else
#define SONOGLIDE_BATCH_DAHL_LANES
#endif

#include <hwy/highway.h>

#include "host_sim/runs/batch/lane_schedule.hpp"

HWY_BEFORE_NAMESPACE();
namespace sonoglide::batch::HWY_NAMESPACE {

/// Good for 1e-4.
struct MapSetting {
  using Scalar = float;
  static constexpr int order = 12;
  static constexpr int reversal_samples = 5;
  static constexpr int root_corrections = 2;
  static constexpr int node_count = 6;
  static constexpr int decay_degree = 5;
  static constexpr float tolerance = 5e-5F;
  static constexpr float least_friction_weight = 1e-4F;
  static constexpr float negligible_deficit = 1e-6F;
  static constexpr float longest_step = 2.5F;
  static constexpr bool counts_work = true;
  static constexpr bool ramped = false;
};

/// Good for 1e-8.
struct FineSetting {
  using Scalar = double;
  static constexpr int order = 16;
  static constexpr int reversal_samples = 5;
  static constexpr int root_corrections = 3;
  static constexpr int node_count = 8;
  static constexpr int decay_degree = 9;
  static constexpr double least_friction_weight = 1e-3;
  static constexpr double tolerance = 2e-9;
  static constexpr double negligible_deficit = 1e-11;
  static constexpr double longest_step = 3.0;
  static constexpr bool counts_work = true;
  static constexpr bool ramped = false;
};

inline const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

inline void run_map(LaneQueue& queue) {
  LaneSchedule<MapSetting>(queue).run();
}

inline void run_fine(LaneQueue& queue) {
  LaneSchedule<FineSetting>(queue).run();
}

}  // namespace sonoglide::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
