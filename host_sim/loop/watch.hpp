/// Who watches a run, and what of it.
#pragma once

#include <functional>
#include <vector>

#include "host_sim/loop/period.hpp"
#include "host_sim/loop/sample.hpp"

namespace sonoglide::loop {

/// Called now and then with the fraction done, in [0, 1].
using Progress = std::function<void(double fraction)>;

/// A sink and the times that it wants to see.
struct Sampling {
  SampleGrid grid;
  SampleSink* sink;
};

/// Watching never changes a bit of the motion, and what nobody watches costs nothing. Sinks outlive
/// the run; what one of them throws ends it.
struct Watch {
  std::vector<PeriodSink*> periods;
  std::vector<Sampling> samples;
  Progress progress;
};

}  // namespace sonoglide::loop
