/// A serial device for a program under test.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::unit {

/// Its other end, a descriptor that is read and written.
class PseudoTerminal {
 public:
  /// @throws std::runtime_error  the system has none left
  PseudoTerminal();

  const std::string& device() const { return device_; }
  int number() const { return master_.number(); }

 private:
  process::Descriptor master_;
  process::Descriptor held_;
  std::string device_;
};

/// A byte link of a unit, on that other end.
class TerminalLink {
 public:
  explicit TerminalLink(const PseudoTerminal& terminal) : number_(terminal.number()) {}
  bool receive(std::uint8_t& byte) const {
    pollfd there{number_, POLLIN, 0};
    return poll(&there, 1, 0) > 0 && read(number_, &byte, 1) == 1;
  }
  bool send(std::uint8_t byte) const { return write(number_, &byte, 1) == 1; }

 private:
  int number_;
};

/// Carries bytes between a pseudo-terminal and two pipes until the pipe that it reads ends.
class Relay {
 public:
  /// @param from  is read to the terminal
  /// @param to    is written from it
  Relay(const PseudoTerminal& terminal, int from, int to)
      : thread_([this, terminal_end = terminal.number(), from, to] {
          carry(terminal_end, from, to);
        }) {}
  ~Relay() {
    over_ = true;
    thread_.join();
  }
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  /// The pipe has ended.
  bool ended() const { return ended_; }

 private:
  void carry(int terminal, int from, int to) {
    constexpr int patience_ms = 20;
    while (!over_ && !ended_) {
      pollfd ends[2] = {{terminal, POLLIN, 0}, {from, POLLIN, 0}};
      poll(ends, 2, patience_ms);
      if ((ends[0].revents & POLLIN) != 0) {
        copy(terminal, to);
      }
      if (ends[1].revents != 0) {
        ended_ = !copy(from, terminal);
      }
    }
  }

  static bool copy(int from, int to) {
    char bytes[256];
    const ssize_t count = read(from, bytes, sizeof bytes);
    return count > 0 && write(to, bytes, static_cast<std::size_t>(count)) == count;
  }

  std::atomic<bool> over_{false};
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace sonoglide::unit
