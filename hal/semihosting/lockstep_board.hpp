/// A board whose carrier periods come from the host, one frame at a time.
#pragma once

#include <cstdint>

#include "hal/board.hpp"
#include "hal/lockstep/frame.hpp"
#include "hal/semihosting/semihosting.hpp"

namespace sonoglide::hal::semihosting {

/// Samples come from the emulator's standard input, drives go to its standard output. The end of
/// the input shuts the board down; a broken link ends the image (ExitCode::link_broken).
class LockstepBoard {
 public:
  LockstepBoard() : input_(open_standard_input()), output_(open_standard_output()) {
    require(input_ >= 0 && output_ >= 0);
  }

  bool sample(Sample& sample) {
    lockstep::SampleFrame frame{};
    const std::size_t received = read_all(input_, frame.data(), frame.size());
    if (received == 0) {
      return false;
    }
    require(received == frame.size() && lockstep::period(frame) == period_);
    sample = lockstep::decode(frame);
    return true;
  }

  void drive(const Drive& drive) {
    const lockstep::DriveFrame frame = lockstep::encode(period_, drive);
    require(write_all(output_, frame.data(), frame.size()));
    ++period_;
  }

 private:
  static void require(bool intact) {
    if (!intact) {
      leave(ExitCode::link_broken);
    }
  }

  std::int32_t input_;
  std::int32_t output_;
  std::uint32_t period_ = 0;
};

}  // namespace sonoglide::hal::semihosting
