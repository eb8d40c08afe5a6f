/// A controller image in lockstep, wherever it runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "hal/board.hpp"
#include "hal/lockstep/frame.hpp"

namespace sonoglide::emulated {

/// The image died, hung or answered out of turn; what() says which, in which carrier period.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The host's end of hal/lockstep/frame.hpp, over any bytes each way.
class LockstepImage {
 public:
  LockstepImage() = default;
  LockstepImage(const LockstepImage&) = delete;
  LockstepImage& operator=(const LockstepImage&) = delete;
  virtual ~LockstepImage() = default;

  /// Waits for the greeting of a board on a serial line, which repeats it until the first frame.
  /// @throws ImageError
  void await_greeting();

  /// One carrier period.
  /// @throws ImageError
  hal::Drive exchange(const hal::Sample& sample);
  /// The same of a unit that observes the vibration.
  hal::ResonantDrive exchange(const hal::VibrationSample& sample);
  /// The same of a unit that answers with a bias.
  hal::BiasedDrive exchange_biased(const hal::Sample& sample);
  hal::BiasedDrive exchange_biased(const hal::MotionSample& sample);

  /// What the latest answer cost, in the unit of the board's counter.
  hal::lockstep::AnswerCost latest_cost() const { return cost_; }

  /// Sends bytes as they are.
  /// @throws ImageError
  virtual void send(const std::uint8_t* bytes, std::size_t size) = 0;

 protected:
  /// Waits for all of them.
  /// @throws ImageError  they do not come in time
  virtual void receive(std::uint8_t* bytes, std::size_t size) = 0;
  /// @throws ImageError  who it is, and what it does wrong
  [[noreturn]] virtual void fail(const std::string& what) const = 0;

  /// Carrier period of the next exchange.
  std::uint32_t period() const { return period_; }

 private:
  template <class Drive, class Sample>
  Drive ask(const Sample& sample);
  std::uint8_t first_byte();

  std::uint32_t period_ = 0;
  bool greeted_ = false;
  hal::lockstep::AnswerCost cost_{};
};

}  // namespace sonoglide::emulated
