/// A controller image on an emulated board, in lockstep.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/board.hpp"
#include "hal/lockstep/frame.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated {

/// The emulator died, hung or answered out of turn; what() says which, in which carrier period, and
/// what the emulator said last.
class EmulatorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs an emulator with its standard input and output connected to this object. The emulator ends
/// with its owner, or with the owner's process.
class ImageProcess {
 public:
  /// @param command   the emulator and its arguments
  /// @param patience  an answer that takes longer never comes
  /// @throws process::ProcessError  the emulator cannot be started
  ImageProcess(const std::vector<std::string>& command, std::chrono::milliseconds patience);

  /// Waits for the greeting of a board on a serial line.
  /// @throws EmulatorError
  void await_greeting();

  /// One carrier period.
  /// @throws EmulatorError
  hal::Drive exchange(const hal::Sample& sample);
  /// The same of a unit that observes the vibration.
  hal::ResonantDrive exchange(const hal::VibrationSample& sample);
  /// The same of a unit that answers with a bias.
  hal::BiasedDrive exchange_biased(const hal::Sample& sample);
  hal::BiasedDrive exchange_biased(const hal::MotionSample& sample);

  /// What the latest answer cost, in the unit of the board's counter.
  hal::lockstep::AnswerCost latest_cost() const { return cost_; }

  /// Sends bytes as they are.
  void send(const std::uint8_t* bytes, std::size_t size);

  /// Ends the input and waits for the image to leave; to be called once, last.
  /// @return its exit code
  /// @throws EmulatorError  it does not leave in time, still sends something, or was ended by a
  /// signal
  int shut_down();

  /// Of the emulator.
  pid_t process() const { return child_->id(); }

 private:
  template <class Drive, class Sample>
  Drive ask(const Sample& sample);
  void receive(std::uint8_t* bytes, std::size_t size);
  void wait_for_answer();
  [[noreturn]] void fail(const std::string& what) const;
  std::string last_words() const;

  std::chrono::milliseconds patience_;
  process::Pipe samples_;
  process::Pipe drives_;
  process::Descriptor complaints_;
  std::optional<process::ChildProcess> child_;
  std::uint32_t period_ = 0;
  hal::lockstep::AnswerCost cost_{};
};

}  // namespace sonoglide::emulated
