/// A serial line.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::process {

/// A serial device or a pseudo-terminal: 8 data bits, no parity, one stop bit, no flow control, bytes
/// as they are. What was received before it was opened is dropped. One at a time has a device: two would each
/// get a part of what comes.
class SerialPort {
 public:
  static constexpr unsigned baud = 115200;

  /// @param device  its path
  /// @throws ProcessError  it cannot be opened, is no serial line, or another program of this kind has it
  explicit SerialPort(const std::string& device);

  const std::string& device() const { return device_; }

  /// @throws ProcessError  the device is gone, or takes nothing for a second
  void send(const std::uint8_t* bytes, std::size_t size);

  /// Waits until the line has what was sent. Not for ever, as tcdrain() does where a device takes nothing.
  void drain(std::chrono::milliseconds limit) const;

  /// @param limit  waits this long at most
  /// @return the bytes received, at most `size`; 0: none came
  /// @throws ProcessError  the device is gone
  std::size_t receive(std::uint8_t* bytes, std::size_t size, std::chrono::milliseconds limit);

 private:
  [[noreturn]] void fail(const std::string& reason) const;

  std::string device_;
  Descriptor line_;
};

}  // namespace sonoglide::process
