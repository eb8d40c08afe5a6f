/// The published measurements beside what the laws say, as charts and as columns.
#pragma once

#include <vector>

#include "host_sim/studies/paper/chart.hpp"
#include "host_sim/studies/paper/experiments.hpp"

namespace sonoglide::paper {

/// What the laws say of Luo's slider, over the sliding velocity.
struct SlowSliding {
  std::vector<double> speeds_mm_per_s;
  std::vector<Interval> coulomb;
  std::vector<Interval> dahl;
  std::vector<Interval> lugre;
  std::vector<Interval> stribeck;
};

/// @throws loop::ComputationError
SlowSliding slow_sliding();

/// The measured points and the least that each law says.
Chart slow_sliding_chart(const SlowSliding& slow);

/// Luo's slider at 0.1 mm/s over the contact stiffness, and what an elastic stick would make of it.
Chart contact_stiffness_chart();

/// Normal vibration over the sliding velocity, for some critical velocities.
Chart normal_vibration_chart();

std::vector<Column> columns(const SlowSliding& slow);

}  // namespace sonoglide::paper
