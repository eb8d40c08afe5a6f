/// The shipped controller alone: codes in, codes out.
#pragma once

#include <cstdint>
#include <memory>

#include "hal/board.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/plant/snapshot.hpp"

namespace sonoglide::python {

class ControllerUnit {
 public:
  /// Begins with the first target of the scene.
  /// @throws configure::ConfigurationError  the scene has no controller, or one that answers with a bias
  explicit ControllerUnit(configure::Experiment experiment);

  /// One control step: the answer to the sample of a carrier period. Of a unit that observes no
  /// vibration that part of the sample is left out, and the answer's frequency is 0.
  const hal::ResonantDrive& step(const hal::VibrationSample& sample) {
    if (scene().sensor.vibration) {
      answer_ = port_->exchange(sample);
    } else {
      static_cast<hal::Drive&>(answer_) = port_->exchange(static_cast<const hal::Sample&>(sample));
    }
    return answer_;
  }

  /// All 0 before the first step.
  const hal::ResonantDrive& answer() const { return answer_; }

  double target() const { return target_; }
  /// @throws std::invalid_argument  it is not in (0, 1]
  void set_target(double friction_ratio);

  bool observes_vibration() const { return scene().sensor.vibration.has_value(); }
  const configure::ControlScales& scales() const { return experiment_.design->scales; }

  loop::Snapshot save() const;
  /// @param state  of a unit of the same scene
  /// @throws std::invalid_argument  it cannot be that
  void restore(const loop::Snapshot& state);

 private:
  const scene::Scene& scene() const { return experiment_.plant; }

  configure::Experiment experiment_;
  std::unique_ptr<loop::ControlPort> port_;
  double target_ = 0.0;
  hal::ResonantDrive answer_{};
};

}  // namespace sonoglide::python
