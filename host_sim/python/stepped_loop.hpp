/// A closed loop that is stepped from outside, in the shape of a task for reinforcement learning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/control_run.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/loop/stepped.hpp"

namespace sonoglide::python {

class SteppedLoop {
 public:
  /// @throws configure::ConfigurationError  the scene has no controller, or its carrier period changes
  explicit SteppedLoop(const configure::Experiment& experiment);

  /// To the beginning of the scene.
  /// @param seed  of the sensor's noise; absent: the scene's
  void reset(std::optional<std::uint64_t> seed);

  /// One carrier period.
  /// @param target  friction ratio in (0, 1] that the controller is given; 0: as before, at the
  ///                beginning the scene's steps
  /// @throws loop::ComputationError, std::invalid_argument  the target is out of range
  void step(double target);

  const loop::SteppedScene& engine() const { return *engine_; }
  double time_s() const { return static_cast<double>(periods_) * period_s_; }
  /// Of the scene, for the period that was stepped last.
  double wanted_ratio() const { return wanted_ratio_; }
  /// Of the scene, for the period that comes next.
  double coming_ratio() const;
  /// The scene's duration is over.
  bool over() const { return periods_ >= scene_periods_; }
  std::uint64_t seed() const { return experiment_.plant.sensor.seed; }

  loop::Snapshot save() const;
  /// @param state  of a loop of the same scene and seed
  /// @throws std::invalid_argument  it cannot be that
  void restore(const loop::Snapshot& state);

 private:
  configure::Experiment experiment_;
  double period_s_;
  std::uint64_t scene_periods_;
  std::vector<loop::ScheduledTarget> schedule_;
  std::unique_ptr<loop::SteppedScene> engine_;
  std::uint64_t periods_ = 0;
  double wanted_ratio_ = 0.0;
};

}  // namespace sonoglide::python
