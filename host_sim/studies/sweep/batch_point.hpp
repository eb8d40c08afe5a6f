/// One point of a sweep as the solver over SIMD lanes takes it.
#pragma once

#include <optional>

#include "host_sim/batch/run_dahl_plants.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

struct BatchPoint {
  batch::DahlPlant plant;
  batch::RunLength length;
  batch::Accuracy accuracy = batch::Accuracy::fine;
};

/// Absent where the lanes cannot do the scene: they take open loop under a drive, Dahl friction,
/// constant sliding velocity, whole carrier periods in run and window, and event_taylor with no
/// order asked for, its tolerance at least 1e-8. From 1e-4 on they compute in float32.
std::optional<BatchPoint> batch_point(const scene::Scene& scene);

/// @param run  solved
PointResult row_of(const BatchPoint& point, const batch::DahlRun& run);

}  // namespace sonoglide::sweep
