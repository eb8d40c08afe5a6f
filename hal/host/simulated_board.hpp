/// The board that a simulation offers to the controller.
#pragma once

#include "hal/board.hpp"

namespace sonoglide::hal::host {

/// A mailbox between plant and controller: the simulation posts a sample, serves one step of the
/// control loop and reads the drive back. No thread, no clock.
///
/// @tparam SampleT  Sample | VibrationSample | MotionSample
/// @tparam DriveT   Drive | ResonantDrive | BiasedDrive
template <class SampleT = Sample, class DriveT = Drive>
class SimulatedBoard {
 public:
  void post(const SampleT& sample) {
    sample_ = sample;
    posted_ = true;
  }
  const DriveT& latest_drive() const { return drive_; }

  bool sample(SampleT& sample) {
    const bool posted = posted_;
    sample = sample_;
    posted_ = false;
    return posted;
  }
  void drive(const DriveT& drive) { drive_ = drive; }

 private:
  SampleT sample_{};
  DriveT drive_{};
  bool posted_ = false;
};

}  // namespace sonoglide::hal::host
