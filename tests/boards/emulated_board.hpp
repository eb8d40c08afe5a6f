/// An image on an emulated board: in lockstep, or on its own with a console.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/board.hpp"

namespace sonoglide::boards {

/// The emulator died, hung or answered out of turn; what() says which.
class EmulatorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs an emulator with its standard input and output, and its monitor, connected to this object.
/// The process ends with its owner, or with the owner's process.
class EmulatedBoard {
 public:
  /// @param command     the emulator and its arguments
  /// @param time_limit  for the whole exchange, from here on; then the emulator is taken to hang
  EmulatedBoard(const std::vector<std::string>& command, std::chrono::milliseconds time_limit);
  ~EmulatedBoard();
  EmulatedBoard(const EmulatedBoard&) = delete;
  EmulatedBoard& operator=(const EmulatedBoard&) = delete;

  /// Waits for the greeting of a board on a serial line.
  /// @throws EmulatorError
  void await_greeting();

  /// One carrier period.
  /// @throws EmulatorError
  hal::Drive exchange(const hal::Sample& sample);

  /// Sends bytes as they are.
  void send(const std::uint8_t* bytes, std::size_t size);

  /// The next line that the board sends, without its end.
  /// @throws EmulatorError
  std::string receive_line();

  /// Asks the emulator for a reset of the board, which comes soon.
  void request_reset();

  /// Waits for the emulator to end by itself.
  /// @return its exit code
  /// @throws EmulatorError when it does not end in time, or was ended by a signal
  int await_end();

  /// Ends the input and waits for the image to leave.
  /// @return its exit code
  /// @throws EmulatorError when it does not leave in time, or was ended by a signal
  int shut_down();

  pid_t process() const { return process_; }

 private:
  void receive(std::uint8_t* bytes, std::size_t size);
  void wait_readable();
  void kill();

  std::chrono::steady_clock::time_point deadline_;
  pid_t process_ = -1;
  int link_ = -1;
  int monitor_ = -1;
  std::uint32_t period_ = 0;
};

}  // namespace sonoglide::boards
