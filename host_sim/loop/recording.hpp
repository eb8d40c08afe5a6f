/// Samples that are kept.
#pragma once

#include <vector>

#include "host_sim/loop/sample.hpp"

namespace sonoglide::loop {

/// Keeps every sample that it is given, column by column.
struct Recording final : SampleSink {
  std::vector<double> time_s;
  std::vector<PlantState> state;
  std::vector<double> drive_force_N;
  std::vector<double> sliding_velocity_m_per_s;

  void take(const Sample& sample) override {
    time_s.push_back(sample.time_s);
    state.push_back(sample.state);
    drive_force_N.push_back(sample.drive_force_N);
    sliding_velocity_m_per_s.push_back(sample.sliding_velocity_m_per_s);
  }
};

}  // namespace sonoglide::loop
