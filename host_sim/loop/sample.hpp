/// States of the plant at times that somebody asks for.
#pragma once

#include "host_sim/loop/plant_port.hpp"

namespace sonoglide::loop {

struct Sample {
  double time_s;
  PlantState state;
  double drive_force_N;
  double sliding_velocity_m_per_s;
};

/// Takes samples in the order of time.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  virtual void take(const Sample& sample) = 0;
};

/// Equally spaced times: begin_s + i·interval_s up to end_s, ends included.
struct SampleGrid {
  double begin_s;
  double end_s;
  double interval_s;
};

}  // namespace sonoglide::loop
