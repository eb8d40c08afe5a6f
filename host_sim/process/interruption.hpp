/// Ends a long command in order when somebody interrupts it.
#pragma once

#include <array>
#include <csignal>
#include <cstddef>
#include <stdexcept>

namespace sonoglide::process {

/// Unwinds an interrupted command, so that no half of an output stays behind.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Holds back SIGINT, SIGTERM and SIGHUP while it lives, but for those that the process ignores.
/// Its destructor lets the one that came do what it would have done at once. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// @throws Interrupted  a signal has come
  void check() const;

 private:
  static constexpr std::array<int, 3> signals = {SIGINT, SIGTERM, SIGHUP};

  std::array<struct sigaction, signals.size()> previous_{};
};

}  // namespace sonoglide::process
