/// A controller image in lockstep, wherever it runs.
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
#include "host_sim/process/serial_port.hpp"

namespace sonoglide::emulated {

/// The image died, hung or answered out of turn; what() says which, in which carrier period.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The host's end of hal/lockstep/frame.hpp, over any bytes each way.
class LockstepImage {
 public:
  /// @param patience  an answer that takes longer never comes
  explicit LockstepImage(std::chrono::milliseconds patience) : patience_(patience) {}
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
  std::chrono::milliseconds patience() const { return patience_; }

 private:
  template <class Drive, class Sample>
  Drive ask(const Sample& sample);
  std::uint8_t first_byte();

  std::chrono::milliseconds patience_;
  std::uint32_t period_ = 0;
  bool greeted_ = false;
  hal::lockstep::AnswerCost cost_{};
};

/// A board in lockstep at the other end of a serial line.
class SerialImage final : public LockstepImage {
 public:
  /// @param port      outlives this
  /// @param patience  an answer that takes longer never comes
  SerialImage(process::SerialPort& port, std::chrono::milliseconds patience)
      : LockstepImage(patience), port_(port) {}

  void send(const std::uint8_t* bytes, std::size_t size) override { port_.send(bytes, size); }

 private:
  void receive(std::uint8_t* bytes, std::size_t size) override;
  [[noreturn]] void fail(const std::string& what) const override;

  process::SerialPort& port_;
};

/// Runs an emulator with its standard input and output connected to this object. The emulator ends
/// with its owner, or with the owner's process.
class ImageProcess final : public LockstepImage {
 public:
  /// @param command   the emulator and its arguments
  /// @param patience  an answer that takes longer never comes
  /// @throws process::ProcessError  the emulator cannot be started
  ImageProcess(const std::vector<std::string>& command, std::chrono::milliseconds patience);

  void send(const std::uint8_t* bytes, std::size_t size) override;

  /// Ends the input and waits for the image to leave; to be called once, last.
  /// @return its exit code
  /// @throws ImageError  it does not leave in time, still sends something, or was ended by a
  /// signal
  int shut_down();

  /// Of the emulator.
  pid_t process() const { return child_->id(); }

 private:
  void receive(std::uint8_t* bytes, std::size_t size) override;
  void wait_for_answer();
  /// With the emulator's last words.
  [[noreturn]] void fail(const std::string& what) const override;
  std::string last_words() const;

  process::Pipe samples_;
  process::Pipe drives_;
  process::Descriptor complaints_;
  std::optional<process::ChildProcess> child_;
};

}  // namespace sonoglide::emulated
