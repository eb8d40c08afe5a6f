/// Descriptors with an owner, pipes, and waiting for what comes through them.
#pragma once

#include <unistd.h>

#include <chrono>
#include <functional>
#include <stdexcept>
#include <utility>

namespace sonoglide::process {

/// what() names the program and the reason.
class ProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Closes what it holds; movable, never copied.
class Descriptor {
 public:
  Descriptor() = default;
  /// @param number  negative: nothing is held
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  int number() const { return number_; }

  void close() {
    if (number_ >= 0) {
      ::close(number_);
      number_ = -1;
    }
  }

 private:
  int number_ = -1;
};

struct Pipe {
  Descriptor read_end;
  Descriptor write_end;
};

/// @throws ProcessError  no descriptors are left
Pipe make_pipe();

/// Called a few times a second while waiting, and whenever a signal has come; what it throws ends
/// the wait.
using Attention = std::function<void()>;

/// @param limit  waits this long at most
/// @return whether there is something to read, the end included
bool wait_for_input(int descriptor, std::chrono::milliseconds limit, const Attention& attention);

}  // namespace sonoglide::process
