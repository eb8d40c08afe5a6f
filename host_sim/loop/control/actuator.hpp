/// The actuator between controller and plant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"
#include "hal/board.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// What drives one carrier period.
struct Command {
  double amplitude_N = 0.0;
  double bias_N = 0.0;         ///< constant over the period, beside the carrier
  std::int32_t frequency = 0;  ///< of a resonant drive: steps of its word from the start
  double target = std::numeric_limits<double>::quiet_NaN();  ///< that it was picked for
  double commanded_ratio = std::numeric_limits<double>::quiet_NaN();
  control::State state = control::State::off;
  control::Limit limit = control::Limit::none;
  control::Settling settling = control::Settling::pending;
};

/// Turns the codes of drive commands into newtons, each in force a latency later.
class Actuator {
 public:
  /// @param scene  says how late an answer acts, which amplitude and bias code 2^31 is, and how fine
  ///               the amplitude is
  explicit Actuator(const scene::Scene& scene);

  /// The answer to the period that has just passed; target: friction ratio it was picked for.
  void take(const hal::Drive& drive, double target) { take(drive, target, 0, 0); }
  void take(const hal::ResonantDrive& drive, double target) {
    take(drive, target, drive.frequency, 0);
  }
  void take(const hal::BiasedDrive& drive, double target) { take(drive, target, 0, drive.bias); }

  /// The answer that was taken last holds for another carrier period.
  void hold();

  /// In force during the next carrier period; off until the first answer acts.
  const Command& in_force() const { return queue_[first_]; }

  void copy_state(StateCopy& copy);

 private:
  void take(const hal::Drive& drive, double target, std::int32_t frequency, std::int32_t bias);

  double full_scale_N_;
  double step_N_;
  double bias_limit_N_;
  std::vector<Command> queue_;  ///< a ring
  std::size_t first_ = 0;       ///< in it
};

}  // namespace sonoglide::loop
