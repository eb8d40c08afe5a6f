/// The board that a simulation offers to the controller.
#pragma once

#include "hal/board.hpp"

namespace sonoglide::hal::host {

/// A mailbox between plant and controller: the simulation posts a sample, serves one step of the
/// control loop and reads the drive back. No thread, no clock.
class SimulatedBoard {
 public:
  void post(const Sample& sample) {
    sample_ = sample;
    posted_ = true;
  }
  const Drive& latest_drive() const { return drive_; }

  bool sample(Sample& sample) {
    const bool posted = posted_;
    sample = sample_;
    posted_ = false;
    return posted;
  }
  void drive(const Drive& drive) { drive_ = drive; }

 private:
  Sample sample_{};
  Drive drive_{};
  bool posted_ = false;
};

}  // namespace sonoglide::hal::host
