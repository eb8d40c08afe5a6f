/// A file descriptor with an owner.
#pragma once

#include <unistd.h>

#include <utility>

namespace sonoglide::process {

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

}  // namespace sonoglide::process
